// A frame: the length of a JSON header, the header, then arrays as they lie in memory.

const KINDS = {
  float32: Float32Array,
  float64: Float64Array,
  int32: Int32Array,
  uint32: Uint32Array,
  uint16: Uint16Array,
  uint8: Uint8Array,
};

/**
 * Read a frame without copying its arrays.
 *
 * @param {ArrayBuffer} buffer
 * @returns {object} the header, with `arrays` as {name: {data, shape}}
 */
export function readFrame(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  const header = JSON.parse(text);
  const arrays = {};
  for (const { name, dtype, shape, offset } of header.arrays) {
    const size = shape.reduce((product, side) => product * side, 1);
    arrays[name] = { data: new KINDS[dtype](buffer, 4 + length + offset, size), shape };
  }
  return { ...header, arrays };
}
