// The stage: one renderer, one canvas, drawn only when something changed.

import { Color, SRGBColorSpace, WebGLRenderer } from "./three.js";

export class Stage {
  /**
   * @param {HTMLElement} host  what the canvas fills
   * @param {HTMLCanvasElement} canvas
   */
  constructor(host, canvas) {
    this.host = host;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.setClearColor(new Color(0), 0);
    this.view = null;
    this.width = this.height = 1;
    this.waiting = false;
    new ResizeObserver(() => this.resize()).observe(host);
    canvas.addEventListener("webglcontextrestored", () => this.draw());
  }

  /** Show a view in place of the one before. */
  show(view) {
    this.view?.leave?.();
    this.view = view;
    view.enter?.();
    this.draw();
  }

  resize() {
    const { width, height } = this.host.getBoundingClientRect();
    if (width < 2 || height < 2) return;
    this.width = width;
    this.height = height;
    this.renderer.setPixelRatio(Math.min(globalThis.devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.paint();
  }

  /** Draw in the next frame, however often this is called before. */
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
    });
  }

  paint() {
    if (!this.view) return;
    this.view.rig.fit(this.width, this.height);
    this.renderer.render(this.view.scene, this.view.rig.camera);
  }
}

/** Free what an object and all below it hold on the graphics card. */
export function dispose(object) {
  object.traverse((each) => {
    each.geometry?.dispose();
    for (const material of [each.material].flat()) {
      if (!material) continue;
      for (const uniform of Object.values(material.uniforms ?? {}))
        uniform.value?.isTexture && uniform.value.dispose();
      material.dispose();
    }
  });
  object.removeFromParent();
}
