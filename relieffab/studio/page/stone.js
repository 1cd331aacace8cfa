// Matt stone, wood or foam under one light and an even sky.

import { Color, DoubleSide, ShaderMaterial, Vector3 } from "./three.js";

// Linear-light colours come from sRGB ones; grain is its strength and its stretch along X.
const LOOKS = {
  limestone: { colour: "#e3d4b9", grain: 0.045, along: 1 },
  marble: { colour: "#e6e3de", grain: 0.03, along: 2.5 },
  granite: { colour: "#a9a29b", grain: 0.16, along: 1 },
  slate: { colour: "#6e757b", grain: 0.05, along: 4 },
  softwood: { colour: "#dfbd8d", grain: 0.055, along: 22 },
  hardwood: { colour: "#a9764c", grain: 0.08, along: 26 },
  mdf: { colour: "#c9a67c", grain: 0.05, along: 1 },
  foam: { colour: "#d9dfe0", grain: 0.02, along: 1 },
};
const CLAY = { colour: "#d6cdbf", grain: 0, along: 1 };

const VERTEX = /* glsl */ `
  #ifdef OPEN
    attribute vec2 openness;
  #endif
  varying vec2 vOpen;
  varying vec3 vNormal;
  varying vec3 vPlace;
  void main() {
    #ifdef OPEN
      vOpen = openness;
    #else
      vOpen = vec2(1.0);
    #endif
    vNormal = mat3(modelMatrix) * normal;
    vPlace = position;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  uniform vec3 stone, light;
  uniform vec2 grain;
  varying vec2 vOpen;
  varying vec3 vNormal;
  varying vec3 vPlace;

  float hash(vec3 p) {
    p = fract(p * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yxz + 33.33);
    return fract((p.x + p.y) * p.z);
  }
  float noise(vec3 p) {
    vec3 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    vec2 e = vec2(0.0, 1.0);
    vec4 low = vec4(hash(i), hash(i + e.yxx), hash(i + e.xyx), hash(i + e.yyx));
    vec4 high = vec4(hash(i + e.xxy), hash(i + e.yxy), hash(i + e.xyy), hash(i + e.yyy));
    vec4 level = mix(low, high, f.z);
    return mix(mix(level.x, level.y, f.x), mix(level.z, level.w, f.x), f.y);
  }
  void main() {
    vec3 n = normalize(vNormal);
    if (!gl_FrontFacing) n = -n;
    float key = max(dot(n, light), 0.0) * vOpen.x;
    float sky = vOpen.y * (0.62 + 0.38 * n.z);
    vec3 body = stone;
    if (grain.x > 0.0) {
      vec3 p = vPlace * vec3(1.0 / grain.y, 1.0, 1.0);
      float rough = noise(p * 1.3) + 0.6 * noise(p * 4.1) + 0.4 * noise(p * 11.0);
      body *= 1.0 + grain.x * (rough - 1.0);
    }
    vec3 colour = (KEY * key + SKY * sky + BOUNCE * (1.0 - vOpen.y) * stone) * body;
    gl_FragColor = vec4(colour, 1.0);
    #include <colorspace_fragment>
  }`;

/** Make a matt material; `open` if the geometry knows how open it lies to light and sky. */
export function stone({ open = false } = {}) {
  return dressed(
    new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      defines: { KEY: "0.98", SKY: "0.3", BOUNCE: "0.14", ...(open ? { OPEN: "" } : {}) },
      uniforms: {
        stone: { value: new Color() },
        grain: { value: [0, 1] },
        light: { value: new Vector3(-0.6, 0.6, 0.53) },
      },
    }),
    null,
  );
}

/** Dress a material as stone, wood or foam; as modelling clay where the name is none of them. */
export function dressed(material, name) {
  const look = LOOKS[name] ?? CLAY;
  material.uniforms.stone.value.set(look.colour);
  material.uniforms.grain.value = [look.grain, look.along];
  return material;
}
