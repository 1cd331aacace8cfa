// The one door to three.js.

export * from "./vendor/three.module.min.js";
