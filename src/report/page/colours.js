// SPDX-License-Identifier: MIT
// Colours that also those tell apart who see fewer of them.

const kColours = {
  ground: 0x11151c, frontier: 0xf0524f, voids: 0xa78bfa, path: 0x56b4e9, plan: 0xf2b134, sensor: 0xffffff,
};

// For runs beside one another, by planner (after Okabe and Ito).
const kRunColours = ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#d55e00", "#0072b2"];

// Ramps as evenly spaced stops; brightness rises along each of them.
const kRamps = {
  height: ["#2b3a67", "#3f5f8a", "#5b8a9a", "#8fb39c", "#cfd0a4", "#f1e3c2", "#fff7ea"],
  time: ["#3b2a73", "#6a3d9a", "#a3478f", "#d55f76", "#f2885c", "#fbbd5b", "#fcf2a4"],
  field: ["#3b0f70", "#8c2981", "#de4968", "#fe9f6d", "#fcfdbf"],
  utility: ["#26456e", "#2d7c9b", "#3fb59a", "#a5d46a", "#fbe94b"],
};

function parsed(colour) {
  return [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16) / 255);
}

// The colour of a ramp at `share` in [0, 1].
function rampAt(name, share) {
  const stops = kRamps[name];
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  const [a, b] = [parsed(stops[i]), parsed(stops[i + 1])];
  return a.map((value, k) => value + (at - i) * (b[k] - value));
}

function rampTexture(name) {
  const texels = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) {
    rampAt(name, i / 255).forEach((value, k) => { texels[4 * i + k] = Math.round(255 * value); });
    texels[4 * i + 3] = 255;
  }
  const texture = new THREE.DataTexture(texels, 256, 1, THREE.RGBAFormat);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

function rampGradient(name) {
  return `linear-gradient(90deg, ${kRamps[name].join(", ")})`;
}
