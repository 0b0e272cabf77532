// SPDX-License-Identifier: Apache-2.0
// Shows `report`: bodies, surfaces and paths in 3D, frame by frame, with curves, events and the table of the run.
"use strict";
(function () {
  const find = (id) => document.getElementById(id);
  const decode = (text, Numbers) => new Numbers(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  report.frames.forEach((frame) => {
    frame.bodies = decode(frame.bodies, Int16Array);
    frame.paths = frame.paths.map((points) => Float32Array.from(decode(points, Int16Array), (x) => x * report.unit));
  });
  report.curves.forEach((curve) => {
    curve.values = Array.from(decode(curve.values, Uint16Array),
                              (x) => x === 65535 ? null : curve.least + x * curve.step);
  });
  const frames = report.frames;
  const first = report.times[0], last = report.times[report.times.length - 1];

  // ---- the scene
  const renderer = new THREE.WebGLRenderer({canvas: find("view"), antialias: true});
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  renderer.setClearColor(0xf7f7f5);
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
  camera.up.fromArray(report.up);
  const controls = new THREE.OrbitControls(camera, find("view"));
  scene.add(new THREE.HemisphereLight(0xffffff, 0x777788, 0.75));
  const sun = new THREE.DirectionalLight(0xffffff, 0.45);
  sun.position.set(0.5, 1, 1);
  camera.add(sun);
  scene.add(camera);

  const bounds = new THREE.Box3();
  frames.forEach((frame) => frame.paths.forEach((path) => {
    for (let i = 0; i < path.length; i += 3)
      bounds.expandByPoint(new THREE.Vector3(path[i], path[i + 1], path[i + 2]));
  }));
  if (bounds.isEmpty()) bounds.expandByPoint(new THREE.Vector3()).expandByScalar(0.5);
  const size = Math.max(bounds.getSize(new THREE.Vector3()).length(), 1e-3);

  const bodies = Array.from({length: frames[0].bodies.length / 7}, () => {
    const body = new THREE.Group();
    body.add(new THREE.AxesHelper((report.bones.length ? 0.025 : 0.06) * size));
    scene.add(body);
    return body;
  });
  function addMesh(described, material) {
    const geometry = new THREE.BufferGeometry();
    const points = Float32Array.from(decode(described.points, Int16Array), (x) => x * described.unit);
    geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    geometry.setIndex(new THREE.BufferAttribute(decode(described.faces, described.short ? Uint16Array : Uint32Array), 1));
    geometry.computeVertexNormals();
    const mesh = new THREE.Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.fromArray(described.pose);
    bodies[described.body].add(mesh);
    return mesh;
  }
  const bone = new THREE.MeshLambertMaterial({color: 0xe8e2d0, side: THREE.DoubleSide});
  const tinted = new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide});
  // Colors of values from -1 to 1: from the first over the middle one to the last.
  const kScale = ["#2166ac", "#f2efe6", "#b2182b"];
  const scaleColors = kScale.map((color) => new THREE.Color(color));
  function tint(mesh, values) {
    const colors = new Float32Array(3 * values.length), color = new THREE.Color();
    values.forEach((value, i) => {
      const v = value / 32767;
      color.copy(scaleColors[1]).lerp(scaleColors[v < 0 ? 0 : 2], Math.abs(v)).toArray(colors, 3 * i);
    });
    mesh.geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
  }
  const bones = report.bones.map((described) => {
    const mesh = addMesh(described, described.values ? tinted : bone);
    if (described.values) tint(mesh, decode(described.values, Int16Array));
    return mesh;
  });
  find("scale").hidden = !report.valueName;
  find("ramp").style.background = "linear-gradient(to right, " + kScale.join(",") + ")";
  find("least").textContent = -report.largestValue;
  find("most").textContent = report.largestValue + "  " + report.valueName;
  const kLifted = 0x9fb3bd, kTouched = 0xe9a86b;
  const surfaces = report.surfaces.map((mesh) => addMesh(mesh, new THREE.MeshLambertMaterial(
      {color: kLifted, side: THREE.DoubleSide, transparent: true, opacity: 0.55, depthWrite: false})));

  const colors = report.paths.map((path, i) => "hsl(" + (i * 137.5 + 200) % 360 + ",60%,42%)");
  const isShown = report.paths.map(() => true);
  // All paths are one object with a color for each segment, and all arcs another, over all else.
  function addLines(most, width, options) {
    const geometry = new THREE.LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(6 * most));
    geometry.setColors(new Float32Array(6 * most));
    const material = new THREE.LineMaterial(Object.assign({linewidth: width}, options));
    const lines = new THREE.LineSegments2(geometry, material);
    lines.frustumCulled = false;
    scene.add(lines);
    return lines;
  }
  const countSegments = (frame) => frame.paths.reduce((sum, path) => sum + Math.max(path.length / 3 - 1, 0), 0);
  const countArcs = (frame) => frame.arcs.reduce((sum, arcs) => sum + arcs.reduce((n, arc) => n + arc[1] - arc[0], 0), 0);
  const lines = addLines(Math.max(1, ...frames.map(countSegments)), 2.5, {vertexColors: THREE.VertexColors});
  const arcs = addLines(Math.max(1, ...frames.map(countArcs)), 4, {color: 0xd1495b, depthTest: false, transparent: true});
  arcs.renderOrder = 1;  // after the surfaces, which are transparent, too
  const rgb = colors.map((color) => new THREE.Color(color).toArray());

  const side = new THREE.Vector3().fromArray(report.up[2] ? [0, -1, 0] : [0, 0, 1]);
  let isPlacedByUser = false;
  controls.addEventListener("start", () => { isPlacedByUser = true; });
  /** Far enough that all fits into a view of this aspect. */
  function placeCamera(aspect) {
    if (isPlacedByUser) return;
    scene.updateMatrixWorld(true);
    const all = bounds.clone();
    bones.forEach((mesh) => all.expandByObject(mesh));
    const extent = all.getSize(new THREE.Vector3()), center = all.getCenter(new THREE.Vector3());
    const half = Math.tan(camera.fov / 2 * Math.PI / 180);
    const height = Math.abs(extent.dot(camera.up)), width = Math.max(extent.length() ** 2 - height ** 2, 0) ** 0.5;
    const distance = 0.35 * width + 0.54 * Math.max(height, width / aspect) / half;
    camera.near = size / 100;
    camera.far = size * 100;
    controls.target.copy(center);
    camera.position.copy(center).addScaledVector(side, distance).addScaledVector(camera.up, 0.18 * distance);
    camera.position.x += 0.25 * distance;
    controls.update();
  }

  /** Copies segments first to last of a path; returns where the next ones go. */
  function copySegments(points, from, to, array, next) {
    for (let k = from; k < to; ++k)
      for (let c = 0; c < 6; ++c) array[next++] = points[3 * k + c];
    return next;
  }
  function update(object, numbers) {
    const geometry = object.geometry;
    geometry.maxInstancedCount = numbers / 6;
    geometry.attributes.instanceStart.data.needsUpdate = true;
    object.visible = numbers > 0;
  }
  function showPaths(frame) {
    const line = lines.geometry.attributes.instanceStart.data.array;
    const tint = lines.geometry.attributes.instanceColorStart.data.array;
    const arc = arcs.geometry.attributes.instanceStart.data.array;
    let nextLine = 0, nextArc = 0;
    frame.paths.forEach((points, i) => {
      if (!isShown[i]) return;
      const begin = nextLine;
      nextLine = copySegments(points, 0, points.length / 3 - 1, line, nextLine);
      for (let k = begin; k < nextLine; ++k) tint[k] = rgb[i][k % 3];
      frame.arcs[i].forEach(([from, to]) => { nextArc = copySegments(points, from, to, arc, nextArc); });
    });
    lines.geometry.attributes.instanceColorStart.data.needsUpdate = true;
    update(lines, nextLine);
    update(arcs, nextArc);
  }

  let current = -1;
  function show(index) {
    if (index === current) return;
    current = index;
    refresh();
  }
  function refresh() {
    const frame = frames[current];
    bodies.forEach((body, b) => {
      const [x, y, z, w, i, j, k] = frame.bodies.subarray(7 * b, 7 * b + 7);
      body.position.set(x, y, z).multiplyScalar(report.unit);
      body.quaternion.set(i, j, k, w).normalize();
    });
    surfaces.forEach((mesh, s) => mesh.material.color.setHex(frame.touched.includes(s) ? kTouched : kLifted));
    showPaths(frame);
    find("slider").value = current;
    find("clock").value = frame.t.toFixed(3) + " s";
    moveCursor();
    draw();
  }

  function draw() {
    const box = find("scene").getBoundingClientRect(), ratio = renderer.getPixelRatio();
    if (renderer.domElement.width !== Math.floor(box.width * ratio) ||
        renderer.domElement.height !== Math.floor(box.height * ratio)) {
      renderer.setSize(box.width, box.height, false);
      [lines, arcs].forEach((object) => object.material.resolution.set(box.width, box.height));
      camera.aspect = box.width / box.height;
      placeCamera(camera.aspect);
      camera.updateProjectionMatrix();
    }
    renderer.render(scene, camera);
  }

  // ---- curves: the cursor is an element over the chart, which is not drawn again for every frame
  let chart = null;
  function moveCursor() {
    if (!chart) return;
    const area = chart.chartArea, cursor = find("cursor");
    cursor.style.left = chart.scales.x.getPixelForValue(frames[Math.max(current, 0)].t) + "px";
    cursor.style.top = area.top + "px";
    cursor.style.height = area.bottom - area.top + "px";
  }
  const names = (curve) => report.paths[curve.path] + (curve.of ? " " + curve.of : "");
  function showCurves(quantity) {
    const curves = report.curves.filter((curve) => curve.quantity === quantity);
    const isPoint = report.times.length === 1;
    const dashes = [[], [6, 3], [2, 2], [8, 3, 2, 3]], seen = {};
    const datasets = curves.map((curve) => {
      seen[curve.path] = seen[curve.path] + 1 || 0;
      return {
        label: names(curve), data: curve.values.map((y, i) => ({x: report.times[i], y: y})),
        borderColor: colors[curve.path], backgroundColor: colors[curve.path], borderWidth: 1.5,
        borderDash: dashes[seen[curve.path] % dashes.length], pointRadius: isPoint ? 3 : 0,
      };
    });
    if (chart) chart.destroy();
    chart = new Chart(find("chart"), {
      type: "line", data: {datasets: datasets},
      options: {
        animation: false, parsing: false, normalized: true, maintainAspectRatio: false, spanGaps: false,
        interaction: {mode: "nearest", axis: "xy", intersect: false},
        scales: {x: {type: "linear", min: isPoint ? first - 0.5 : first, max: isPoint ? first + 0.5 : last,
                     title: {display: true, text: "time [s]"}},
                 y: {title: {display: true, text: quantity}}},
        plugins: {legend: {display: false}},
        onClick: (event) => { stop(); show(nearest(chart.scales.x.getValueForPixel(event.x))); },
        onResize: () => setTimeout(moveCursor),
      },
    });
    showLegend(datasets);
    moveCursor();
  }
  function showLegend(datasets) {
    const legend = find("legend");
    legend.textContent = "";
    datasets.forEach((dataset, i) => {
      const entry = document.createElement("button");
      entry.style.setProperty("--color", dataset.borderColor);
      entry.textContent = dataset.label;
      entry.title = "show or hide this curve";
      entry.addEventListener("click", () => setVisible(i, !chart.isDatasetVisible(i)));
      legend.appendChild(entry);
    });
  }
  function setVisible(i, isVisible) {
    chart.setDatasetVisibility(i, isVisible);
    find("legend").children[i].classList.toggle("off", !isVisible);
    chart.update();
  }
  function setAllVisible(isVisible) {
    chart.data.datasets.forEach((dataset, i) => {
      chart.setDatasetVisibility(i, isVisible);
      find("legend").children[i].classList.toggle("off", !isVisible);
    });
    chart.update();
  }
  const quantities = [...new Set(report.curves.map((curve) => curve.quantity))];
  quantities.forEach((quantity) => find("quantity").add(new Option(quantity, quantity)));
  find("quantity").addEventListener("change", (event) => showCurves(event.target.value));
  find("all").addEventListener("click", () => setAllVisible(true));
  find("none").addEventListener("click", () => setAllVisible(false));

  // ---- what is drawn
  function addSwitch(id, isThere, set) {
    find(id).parentElement.hidden = !isThere;
    find(id).addEventListener("change", (event) => { set(event.target.checked); draw(); });
  }
  const setVisibility = (objects) => (isVisible) => objects.forEach((object) => { object.visible = isVisible; });
  addSwitch("bones", bones.length > 0, setVisibility(bones));
  addSwitch("surfaces", surfaces.length > 0, setVisibility(surfaces));
  addSwitch("frames", true, setVisibility(bodies.map((body) => body.children[0])));

  // ---- time
  function nearest(time) {
    let low = 0, high = frames.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (frames[middle].t <= time) low = middle; else high = middle;
    }
    return time - frames[low].t <= frames[high].t - time ? low : high;
  }
  find("slider").max = frames.length - 1;
  find("player").hidden = frames.length === 1;
  find("slider").addEventListener("input", (event) => { stop(); show(Number(event.target.value)); });
  const end = frames[frames.length - 1].t;
  let startedAt = null, startedFrom = 0;
  function stop() {
    startedAt = null;
    find("play").textContent = "\u25b6";
  }
  function tick(now) {
    if (startedAt === null) return;
    const time = startedFrom + (now - startedAt) / 1000 * Number(find("speed").value);
    show(nearest(Math.min(time, end)));
    if (time >= end) return stop();
    requestAnimationFrame(tick);
  }
  find("play").addEventListener("click", () => {
    if (startedAt !== null) return stop();
    find("play").textContent = "\u275a\u275a";
    startedAt = performance.now();
    startedFrom = current === frames.length - 1 ? frames[0].t : frames[current].t;
    requestAnimationFrame(tick);
  });
  find("speed").addEventListener("change", () => {
    startedFrom = frames[current].t;
    if (startedAt !== null) startedAt = performance.now();
  });
  const kinds = {touchdown: "#2a9d8f", liftoff: "#e9a13b", slipped: "#d1495b", split: "#7b2d8b", left_hole: "#7b2d8b"};
  function drawEvents() {
    const canvas = find("events"), width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d"), begin = frames[0].t;
    report.events.forEach((event) => {
      context.fillStyle = kinds[event.kind] || "#222";
      context.fillRect(8 + (width - 16) * (event.t - begin) / (end - begin || 1) - 1, 2, 2, height - 4);
    });
  }
  const observer = new ResizeObserver(() => { draw(); drawEvents(); moveCursor(); });
  observer.observe(find("scene"));
  controls.addEventListener("change", draw);

  // ---- words
  function addCells(row, tag, cells) {
    cells.forEach((cell, i) => {
      const element = document.createElement(tag);
      element.textContent = cell;
      if (i === cells.length - 1) element.className = "words";
      row.appendChild(element);
    });
    return row;
  }
  document.querySelector("h1").textContent = report.title;
  find("summary").textContent = report.summary;
  document.querySelector("thead").appendChild(addCells(document.createElement("tr"), "th", report.headings));
  report.rows.forEach((row) => {
    const tr = addCells(document.createElement("tr"), "td", row.cells);
    if (row.fault) tr.className = "bad";
    document.querySelector("tbody").appendChild(tr);
  });
  find("eventcount").textContent = report.events.length;
  report.events.forEach((event) => {
    const link = document.createElement("button");
    link.textContent = event.t.toFixed(4) + " s: " + event.path + (event.obstacle ? ", " + event.obstacle : "") + ": " + event.kind;
    link.addEventListener("click", () => { stop(); show(nearest(event.t)); });
    find("eventlist").appendChild(link);
  });

  if (quantities.length) showCurves(quantities[0]); else find("curves").hidden = true;
  show(0);
  drawEvents();
  // For tests and the curious: what the page is made of.
  window.tautline = {show: show, scene: scene, camera: camera, lines: lines, arcs: arcs, surfaces: surfaces, bones: bones,
                     getChart: () => chart, renderer: renderer};
})();
