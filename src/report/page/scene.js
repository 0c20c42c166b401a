// SPDX-License-Identifier: MIT
// One run in three dimensions.

// The bytes of a string in base64 that were packed by deflate.
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function poseParts([x, y, z, qx, qy, qz, qw]) {
  const turn = new THREE.Quaternion(qx, qy, qz, qw);
  const along = (a, b, c) => new THREE.Vector3(a, b, c).applyQuaternion(turn);
  return { at: new THREE.Vector3(x, y, z), right: along(1, 0, 0), down: along(0, 1, 0), ahead: along(0, 0, 1) };
}

class Scene {
  constructor(container, run) {
    this.container = container;
    this.run = run;
    this.replay = run.replay;
    this.views = run.report.cycles;
    this.layers = {};
    this.slice = 0;
    this.dirty = true;
  }

  async build() {
    const { cell_m: cell, lo, hi } = this.replay;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setClearColor(kColours.ground);
    this.container.appendChild(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.05, 1000);
    this.camera.up.set(0, 0, 1);
    const vector = (v) => new THREE.Vector3(...v);
    this.low = vector(lo).multiplyScalar(cell);
    this.high = vector(hi).multiplyScalar(cell);
    this.reach = Math.max(this.high.distanceTo(this.low), 0.1);
    this.common = {
      lo: { value: vector(lo) }, cell: { value: cell }, now: { value: 1 }, last: { value: this.views.length },
      cut: { value: 1e9 }, bottom: { value: this.low.z }, top: { value: this.high.z }, byTime: { value: 0 },
      ramp: { value: null }, ground: { value: new THREE.Color(kColours.ground) },
      glow: { value: new THREE.Color(0xffd98a) }, fogFrom: { value: 1 }, fogTo: { value: 2 },
      pixels: { value: 1000 }, size: { value: new THREE.Vector2(1, 1) },
    };
    this.ramps = { height: rampTexture("height"), time: rampTexture("time") };
    this.common.ramp.value = this.ramps.height;
    await this.addCells();
    this.addGround();
    this.addWays();
    this.addField(await unpacked(this.replay.field.data));
    this.placeCamera();
    new ResizeObserver(() => this.resize()).observe(this.container);
    this.resize();
  }

  async addCells() {
    const { surfaces, voids, frontiers } = this.replay;
    const layer = new QuadLayer(await unpacked(surfaces.data), surfaces.counts, this.common, null);
    this.add("surfaces", layer.group);
    this.focus = this.focusOn(layer.span);
    if (voids.counts.some((n) => n > 0)) {
      this.add("voids", new QuadLayer(await unpacked(voids.data), voids.counts, this.common, kColours.voids).group);
    }
    this.add("frontiers",
      new PointLayer(await unpacked(frontiers.data), frontiers.count, this.common, kColours.frontier).group);
  }

  // What to look at: the surfaces and the path; all that is known where there are none.
  focusOn(span) {
    const { cell_m: cell, lo, travelled } = this.replay;
    const box = new THREE.Box3();
    if (Number.isFinite(span[0][0])) {
      for (const end of [0, 1]) box.expandByPoint(new THREE.Vector3(...span.map((s, k) => (lo[k] + s[end]) * cell)));
      travelled.forEach((point) => box.expandByPoint(new THREE.Vector3(...point)));
    } else {
      box.set(this.low, this.high);
    }
    return box;
  }

  // Lines a metre apart, or ten, below everything: what tells how large things are.
  addGround() {
    const step = this.reach > 80 ? 10 : 1;
    const [low, high] = [this.low, this.high].map((p) => p.clone().divideScalar(step));
    const [x0, y0, x1, y1] = [Math.floor(low.x), Math.floor(low.y), Math.ceil(high.x), Math.ceil(high.y)];
    const z = this.low.z - 0.02 * this.common.cell.value;
    const points = [];
    for (let x = x0; x <= x1; ++x) points.push(x * step, y0 * step, z, x * step, y1 * step, z);
    for (let y = y0; y <= y1; ++y) points.push(x0 * step, y * step, z, x1 * step, y * step, z);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(points), 3));
    this.add("ground", new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x2c3646 })));
    this.groundStep = step;
  }

  addWays() {
    this.path = new LineLayer(this.common, kColours.path, 2.6, false);
    this.path.setWay(this.replay.travelled);
    this.plan = new LineLayer(this.common, kColours.plan, 2.2, true);
    this.frustum = new LineLayer(this.common, kColours.sensor, 1.6, false);
    this.candidates = new ArrowLayer(this.common);
    this.add("path", this.path.group);
    this.add("plan", this.plan.group);
    this.add("sensor", this.frustum.group);
    const cycles = this.replay.cycles;
    if (cycles.some((cycle) => cycle.candidates && cycle.candidates.length > 0)) {
      this.add("candidates", this.candidates.group);
    }
  }

  // Columns of all samples: places in cells, directions, ranks of the potential.
  addField(blob) {
    const n = this.replay.field.count;
    if (n === 0) return;
    this.field = {
      cell: new Uint16Array(blob, 0, 3 * n), way: new Int8Array(blob, 6 * n, 3 * n),
      rank: new Uint8Array(blob, 9 * n, n), arrows: new ArrowLayer(this.common),
    };
    this.add("field", this.field.arrows.group);
  }

  // A layer is an object within a group, so that being switched off and having nothing to show do not mix.
  add(name, object) {
    this.layers[name] = new THREE.Group();
    this.layers[name].add(object);
    this.scene.add(this.layers[name]);
  }

  // From above and the side, just so far away that all of the world is in view.
  placeCamera() {
    const middle = this.focus.getCenter(new THREE.Vector3());
    const half = this.focus.getSize(new THREE.Vector3()).multiplyScalar(0.5);
    const back = new THREE.Vector3(-0.42, -0.8, 0.95).normalize();
    const right = new THREE.Vector3(0, 0, 1).cross(back).normalize();
    const up = back.clone().cross(right);
    const tall = Math.tan(THREE.Math.degToRad(this.camera.fov) / 2) * 0.9;
    const wide = tall * (this.container.clientWidth - this.reserved()) / Math.max(this.container.clientHeight, 1);
    let away = this.reach / 10;
    for (let k = 0; k < 8; ++k) {
      const corner = new THREE.Vector3(k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z);
      const aside = Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / tall);
      away = Math.max(away, corner.dot(back) + aside);
    }
    this.camera.near = this.reach / 2000;
    this.camera.far = this.reach * 20;
    this.camera.position.copy(middle).addScaledVector(back, away);
    this.camera.updateProjectionMatrix();
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.copy(middle);
    this.controls.screenSpacePanning = true;
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.minDistance = this.reach / 100;
    this.controls.maxDistance = this.reach * 6;
    this.controls.addEventListener("change", () => { this.dirty = true; });
    this.controls.update();
  }

  // Pixels on the left that the legend lies over.
  reserved() {
    return this.container.clientWidth > 800 ? 210 : 0;
  }

  resize() {
    const [width, height] = [this.container.clientWidth, this.container.clientHeight];
    if (width === 0 || height === 0) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, -this.reserved() / 2, 0, width, height);
    this.camera.updateProjectionMatrix();
    this.common.size.value.set(width, height);
    this.common.pixels.value = height * ratio / Math.tan(THREE.Math.degToRad(this.camera.fov) / 2) * 0.5;
    this.dirty = true;
  }

  // Shows the run as it was after view number `now`.
  seek(now) {
    this.now = Math.min(Math.max(now, 1), this.views.length);
    this.common.now.value = this.now;
    const view = this.views[this.now - 1];
    this.path.uniforms.until.value = view.path_length_m;
    const cycles = this.replay.cycles;
    this.plannedAt = this.now;
    while (this.plannedAt > 1 && !cycles[this.plannedAt - 1].planned) --this.plannedAt;
    const planned = cycles[this.plannedAt - 1];
    this.plan.setWay(planned && planned.path ? planned.path : []);
    this.showSensor(poseParts(view.pose));
    this.showCandidates(planned);
    this.showField();
    this.dirty = true;
  }

  showSensor({ at, right, down, ahead }) {
    const sensor = this.replay.sensor;
    const size = Math.min(sensor.max_range_m, 0.13 * this.reach);
    const point = (x, y, z) =>
      at.clone().addScaledVector(right, x).addScaledVector(down, y).addScaledVector(ahead, z).toArray().concat(0);
    const segments = [];
    if (sensor.pinhole) {
      const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) =>
        point(x * Math.tan(sensor.horizontal_rad / 2) * size, y * Math.tan(sensor.vertical_rad / 2) * size, size));
      corners.forEach((corner, i) => segments.push([point(0, 0, 0), corner], [corner, corners[(i + 1) % 4]]));
    } else {
      const steps = 40;
      const half = sensor.horizontal_rad / 2;
      const radius = 0.3 * size;
      const ring = (tilt) => Array.from({ length: steps + 1 }, (_, i) => {
        const turn = -half + 2 * half * i / steps;
        return point(radius * Math.sin(turn) * Math.cos(tilt), -radius * Math.sin(tilt),
          radius * Math.cos(turn) * Math.cos(tilt));
      });
      for (const tilt of [-sensor.vertical_rad / 3, 0, sensor.vertical_rad / 3]) {
        const points = ring(tilt);
        points.slice(1).forEach((p, i) => segments.push([points[i], p]));
      }
      segments.push([point(0, 0, 0), point(0, 0, 1.5 * radius)]);
    }
    this.frustum.setSegments(segments);
  }

  showCandidates(planned) {
    const views = planned && planned.candidates ? planned.candidates : [];
    const best = Math.max(...views.map((view) => view[6]), 1e-9);
    const size = 0.022 * this.reach;
    this.candidates.setArrows(views.map((view) => ({
      at: view.slice(0, 3), way: view.slice(3, 6), colour: rampAt("utility", view[6] / best),
      size: size * (0.55 + 0.75 * view[6] / best),
    })));
  }

  // The samples in the layer next to the slice, of the plan that is followed.
  showField() {
    if (!this.field) return;
    const block = this.replay.field.blocks.find((b) => b.view === this.plannedAt);
    const arrows = [];
    if (block) {
      const { cell_m: cell, lo } = this.replay;
      const { cell: places, way, rank } = this.field;
      const zOf = (i) => (lo[2] + places[3 * i + 2] + 0.5) * cell;
      let layer = Infinity;
      for (let i = block.from; i < block.to; ++i) {
        if (Math.abs(zOf(i) - this.slice) < Math.abs(layer - this.slice)) layer = zOf(i);
      }
      for (let i = block.from; i < block.to; ++i) {
        const length = Math.hypot(way[3 * i], way[3 * i + 1], way[3 * i + 2]);
        if (Math.abs(zOf(i) - layer) > 0.01 * cell || length === 0) continue;
        arrows.push({
          at: [0, 1, 2].map((k) => (lo[k] + places[3 * i + k] + 0.5) * cell),
          way: [0, 1, 2].map((k) => way[3 * i + k] / length),
          colour: rampAt("field", rank[i] / 255), size: 0.9 * block.step * cell,
        });
      }
    }
    this.field.arrows.setArrows(arrows);
  }

  setSlice(z) {
    this.slice = z;
    this.showField();
    this.dirty = true;
  }

  setCut(z) {
    this.common.cut.value = z;
    this.dirty = true;
  }

  setColouring(byTime) {
    this.common.byTime.value = byTime ? 1 : 0;
    this.common.ramp.value = byTime ? this.ramps.time : this.ramps.height;
    this.dirty = true;
  }

  setShown(name, shown) {
    if (this.layers[name]) this.layers[name].visible = shown;
    this.dirty = true;
  }

  draw() {
    this.controls.update();
    if (!this.dirty) return;
    this.dirty = false;
    const far = this.camera.position.distanceTo(this.controls.target);
    this.common.fogFrom.value = far;
    this.common.fogTo.value = far + 1.2 * this.reach;
    this.renderer.render(this.scene, this.camera);
  }
}
