// SPDX-License-Identifier: MIT
// What a scene is made of. Everything that comes and goes with time carries the views between which it is there, and
// the graphics card picks what to draw: moving the slider changes one number.

const kNever = 65535;

// Axes of the faces that look along -x +x -y +y -z +z: along their width, along their height, outwards.
const kFaceAxes = [
  [[0, 1, 0], [0, 0, 1], [-1, 0, 0]], [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  [[1, 0, 0], [0, 0, 1], [0, -1, 0]], [[1, 0, 0], [0, 0, 1], [0, 1, 0]],
  [[1, 0, 0], [0, 1, 0], [0, 0, -1]], [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
];
const kFaceLight = [0.74, 0.82, 0.66, 0.88, 0.5, 1.0];

function column(array, size = 1) {
  return new THREE.InstancedBufferAttribute(array, size);
}

// Rectangles of cell faces; seen from their free side only, so that one looks into a room past its outer walls.
const kQuadVertex = `
  attribute float x, y, z, w, h, birth, death;
  uniform vec3 lo, alongU, alongV, outwards;
  uniform float cell, now;
  varying vec2 inCells;
  varying vec3 world;
  varying float born;
  void main() {
    vec3 corner = vec3(x, y, z) + max(outwards, 0.0);
    inCells = vec2(position.x * w, position.y * h);
    world = (lo + corner + alongU * inCells.x + alongV * inCells.y) * cell;
    born = birth;
    bool there = birth <= now && now < death && dot(outwards, cameraPosition - world) > 0.0;
    gl_Position = there ? projectionMatrix * viewMatrix * vec4(world, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  }`;
const kQuadFragment = `
  uniform sampler2D ramp;
  uniform vec3 tint, ground, glow;
  uniform float light, now, last, cut, bottom, top, byTime, tinted, opacity, fogFrom, fogTo;
  varying vec2 inCells;
  varying vec3 world;
  varying float born;
  void main() {
    if (world.z > cut) discard;
    float share = byTime > 0.5 ? (born - 1.0) / max(last - 1.0, 1.0) : (world.z - bottom) / max(top - bottom, 1e-3);
    vec3 colour = mix(texture2D(ramp, vec2(clamp(share, 0.002, 0.998), 0.5)).rgb, tint, tinted) * light;
    vec2 edge = abs(fract(inCells - 0.5) - 0.5);
    vec2 wide = fwidth(inCells);
    vec2 line = 1.0 - smoothstep(vec2(0.0), wide * 1.2, edge);
    float fine = 1.0 - smoothstep(0.08, 0.4, max(wide.x, wide.y));
    colour *= 1.0 - 0.26 * max(line.x, line.y) * fine;
    if (abs(born - now) < 0.5 && now > 1.0 && tinted < 0.5) colour = mix(colour, glow * (0.55 + 0.45 * light), 0.42);
    float far = distance(cameraPosition, world);
    colour = mix(colour, ground, 0.55 * smoothstep(fogFrom, fogTo, far));
    gl_FragColor = vec4(colour, opacity);
  }`;

class QuadLayer {
  // `blob` holds the columns x y z w h birth death; `counts` how many quads look in each of the six directions.
  constructor(blob, counts, common, tint) {
    this.group = new THREE.Group();
    this.materials = [];
    const total = counts.reduce((a, b) => a + b, 0);
    const columns = new Uint16Array(blob);
    this.span = [0, 1, 2].map((i) => columns.subarray(i * total, (i + 1) * total)
      .reduce(([low, high], at) => [Math.min(low, at), Math.max(high, at + 1)], [Infinity, -Infinity]));
    const corners = new THREE.BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]), 3);
    for (let d = 0, from = 0; d < 6; from += counts[d++]) {
      if (counts[d] === 0) continue;
      const geometry = new THREE.InstancedBufferGeometry();
      geometry.setAttribute("position", corners);
      geometry.setIndex([0, 1, 2, 0, 2, 3]);
      ["x", "y", "z", "w", "h", "birth", "death"].forEach((name, i) => {
        geometry.setAttribute(name, column(columns.subarray(i * total + from, i * total + from + counts[d])));
      });
      geometry.maxInstancedCount = counts[d];
      const [u, v, n] = kFaceAxes[d].map((axis) => new THREE.Vector3(...axis));
      const material = new THREE.ShaderMaterial({
        vertexShader: kQuadVertex, fragmentShader: kQuadFragment, side: THREE.DoubleSide,
        extensions: { derivatives: true },
        transparent: tint !== null, depthWrite: tint === null,
        uniforms: Object.assign({
          alongU: { value: u }, alongV: { value: v }, outwards: { value: n }, light: { value: kFaceLight[d] },
          tint: { value: new THREE.Color(tint === null ? 0 : tint) }, tinted: { value: tint === null ? 0 : 1 },
          opacity: { value: tint === null ? 1 : 0.34 },
        }, common),
      });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
  }
}

// Cells as round points that are as large as a part of a cell.
class PointLayer {
  constructor(blob, count, common, colour) {
    const columns = new Uint16Array(blob);
    const geometry = new THREE.BufferGeometry();
    ["x", "y", "z", "birth", "death"].forEach((name, i) => {
      geometry.setAttribute(name, new THREE.BufferAttribute(columns.subarray(i * count, (i + 1) * count), 1));
    });
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    const material = new THREE.ShaderMaterial({
      vertexShader: `
        attribute float x, y, z, birth, death;
        uniform vec3 lo;
        uniform float cell, now, pixels, cut;
        void main() {
          vec3 world = (lo + vec3(x, y, z) + 0.5) * cell;
          bool there = birth <= now && now < death && world.z <= cut;
          gl_Position = there ? projectionMatrix * viewMatrix * vec4(world, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
          gl_PointSize = there ? max(1.5, 0.42 * cell * pixels / gl_Position.w) : 0.0;
        }`,
      fragmentShader: `
        uniform vec3 tint;
        void main() {
          float r = length(gl_PointCoord - 0.5);
          if (r > 0.5) discard;
          gl_FragColor = vec4(tint * (1.08 - 0.5 * r), 1.0);
        }`,
      uniforms: Object.assign({ tint: { value: new THREE.Color(colour) } }, common),
    });
    this.group = new THREE.Points(geometry, material);
    this.group.frustumCulled = false;
  }
}

// Lines a few pixels wide. Segments are pairs of points with the way travelled at each, in metres.
class LineLayer {
  constructor(common, colour, width, dashed) {
    this.geometry = new THREE.InstancedBufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(
      new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.uniforms = Object.assign({
      tint: { value: new THREE.Color(colour) }, wide: { value: width }, until: { value: 1e9 },
      dash: { value: dashed ? 0.22 : 0 }, strength: { value: 1 },
    }, common);
    const material = new THREE.ShaderMaterial({
      side: THREE.DoubleSide, transparent: true, depthTest: true, uniforms: this.uniforms,
      vertexShader: `
        attribute vec4 a, b;
        uniform vec2 size;
        uniform float wide;
        varying float along;
        void main() {
          vec4 p = projectionMatrix * viewMatrix * vec4(a.xyz, 1.0);
          vec4 q = projectionMatrix * viewMatrix * vec4(b.xyz, 1.0);
          p.z -= 0.0006 * p.w;
          q.z -= 0.0006 * q.w;
          vec2 way = (q.xy / q.w - p.xy / p.w) * size;
          way = length(way) > 1e-6 ? normalize(way) : vec2(1.0, 0.0);
          vec2 aside = vec2(-way.y, way.x) * position.y + way * (position.x * 2.0 - 1.0);
          vec4 end = position.x > 0.5 ? q : p;
          along = position.x > 0.5 ? b.w : a.w;
          gl_Position = min(p.w, q.w) > 0.0 ? vec4(end.xy + aside * wide / size * end.w, end.zw)
                                            : vec4(2.0, 2.0, 2.0, 1.0);
        }`,
      fragmentShader: `
        uniform vec3 tint;
        uniform float until, dash, strength;
        varying float along;
        void main() {
          if (along > until + 1e-4 || (dash > 0.0 && fract(along / dash) > 0.62)) discard;
          gl_FragColor = vec4(tint, strength);
        }`,
    });
    this.group = new THREE.Mesh(this.geometry, material);
    this.group.frustumCulled = false;
    this.setSegments([]);
  }

  // `segments`: [from, to] with points [x, y, z, way].
  setSegments(segments) {
    this.geometry.dispose();  // of what the graphics card holds
    const n = Math.max(segments.length, 1);
    const a = new Float32Array(4 * n);
    const b = new Float32Array(4 * n);
    segments.forEach(([from, to], i) => { a.set(from, 4 * i); b.set(to, 4 * i); });
    this.geometry.setAttribute("a", column(a, 4));
    this.geometry.setAttribute("b", column(b, 4));
    this.geometry.maxInstancedCount = segments.length;
    this.group.visible = segments.length > 0;
  }

  setWay(points) {
    let way = 0;
    const withWay = points.map((p, i) => {
      if (i > 0) way += Math.hypot(...p.map((value, k) => value - points[i - 1][k]));
      return [p[0], p[1], p[2], way];
    });
    this.setSegments(withWay.slice(1).map((p, i) => [withWay[i], p]));
  }
}

// Arrows that stand at places and point along directions, each in a colour of its own.
class ArrowLayer {
  constructor(common) {
    const cone = new THREE.ConeBufferGeometry(0.22, 1, 7);
    this.geometry = new THREE.InstancedBufferGeometry();
    this.geometry.setIndex(cone.index);
    this.geometry.setAttribute("position", cone.attributes.position);
    this.geometry.setAttribute("normal", cone.attributes.normal);
    const material = new THREE.ShaderMaterial({
      uniforms: common,
      vertexShader: `
        attribute vec3 at, way, colour;
        attribute float size;
        varying vec3 shade;
        void main() {
          vec3 side = normalize(abs(way.z) < 0.9 ? cross(way, vec3(0.0, 0.0, 1.0)) : cross(way, vec3(1.0, 0.0, 0.0)));
          mat3 turn = mat3(side, way, cross(side, way));
          vec3 world = at + turn * position * size;
          shade = colour * (0.72 + 0.28 * dot(turn * normal, normalize(vec3(0.3, 0.2, 1.0))));
          gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
        }`,
      fragmentShader: "varying vec3 shade; void main() { gl_FragColor = vec4(shade, 1.0); }",
    });
    this.group = new THREE.Mesh(this.geometry, material);
    this.group.frustumCulled = false;
    this.setArrows([]);
  }

  // `arrows`: {at, way, colour, size}, directions of unit length.
  setArrows(arrows) {
    this.geometry.dispose();
    const n = Math.max(arrows.length, 1);
    const [at, way, colour, size] = [3, 3, 3, 1].map((k) => new Float32Array(k * n));
    arrows.forEach((arrow, i) => {
      at.set(arrow.at, 3 * i);
      way.set(arrow.way, 3 * i);
      colour.set(arrow.colour, 3 * i);
      size[i] = arrow.size;
    });
    this.geometry.setAttribute("at", column(at, 3));
    this.geometry.setAttribute("way", column(way, 3));
    this.geometry.setAttribute("colour", column(colour, 3));
    this.geometry.setAttribute("size", column(size));
    this.geometry.maxInstancedCount = arrows.length;
    this.count = arrows.length;
    this.group.visible = arrows.length > 0;
  }
}
