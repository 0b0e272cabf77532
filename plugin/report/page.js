// SPDX-License-Identifier: Apache-2.0
// Shows `report`: bodies, surfaces and paths in 3D, frame by frame, with curves, events and the table of the run.
"use strict";
(function () {
  const decode = (text, Numbers) => new Numbers(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  report.frames.forEach((frame) => {
    frame.bodies = decode(frame.bodies, Float32Array);
    frame.paths = frame.paths.map((points) => Float32Array.from(decode(points, Int16Array), (x) => x * report.unit));
  });
  report.curves.forEach((curve) => {
    curve.values = Array.from(decode(curve.values, Uint16Array),
                              (x) => x === 65535 ? null : curve.least + x * curve.step);
  });
  const find = (id) => document.getElementById(id);
  const frames = report.frames;
  const times = frames.map((frame) => frame.t);
  const duration = times[times.length - 1] - times[0];

  // ---- the scene
  const renderer = new THREE.WebGLRenderer({canvas: find("view"), antialias: true});
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setClearColor(0xf7f7f5);
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
  camera.up.fromArray(report.up);
  const controls = new THREE.OrbitControls(camera, find("view"));
  scene.add(new THREE.HemisphereLight(0xffffff, 0x888899, 0.9));
  const sun = new THREE.DirectionalLight(0xffffff, 0.5);
  camera.add(sun);
  scene.add(camera);

  const bounds = new THREE.Box3();
  frames.forEach((frame) => frame.paths.forEach((path) => {
    for (let i = 0; i < path.length; i += 3)
      bounds.expandByPoint(new THREE.Vector3(path[i], path[i + 1], path[i + 2]));
  }));
  if (bounds.isEmpty()) bounds.expandByPoint(new THREE.Vector3()).expandByScalar(0.5);
  const size = Math.max(bounds.getSize(new THREE.Vector3()).length(), 1e-3);

  const bodies = report.bodies.map(() => {
    const body = new THREE.Group();
    body.matrixAutoUpdate = false;
    body.add(new THREE.AxesHelper(0.06 * size));
    scene.add(body);
    return body;
  });
  const kLifted = 0xc8c4b8, kTouched = 0xe9a86b;
  const surfaces = report.surfaces.map((surface) => {
    const geometry = new THREE.BufferGeometry();
    const points = Float32Array.from(decode(surface.points, Int16Array), (x) => x * surface.unit);
    const corners = decode(surface.faces, surface.short ? Uint16Array : Uint32Array), triangles = [];
    for (let i = 0; i < corners.length; i += 4)  // each of four corners
      [0, 1, 2, 0, 2, 3].forEach((corner) => triangles.push(corners[i + corner]));
    geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    geometry.setIndex(triangles);
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial(
        {color: kLifted, side: THREE.DoubleSide, transparent: true, opacity: 0.55});
    const mesh = new THREE.Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.fromArray(surface.pose);
    bodies[surface.body].add(mesh);
    return mesh;
  });
  const hues = report.paths.map((path, i) => (i * 137.5 + 200) % 360);
  const colors = hues.map((hue) => "hsl(" + hue + ",55%,42%)");
  const lines = report.paths.map((path, i) => {
    const most = Math.max(2, ...frames.map((frame) => frame.paths[i].length / 3));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(3 * most), 3));
    const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({color: new THREE.Color(colors[i])}));
    line.frustumCulled = false;
    scene.add(line);
    return line;
  });
  const arcs = lines.map((line, i) => {  // arcs on surfaces, drawn over all else
    const most = Math.max(1, ...frames.map((frame) => frame.arcs[i].reduce((sum, arc) => sum + arc[1] - arc[0], 0)));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(6 * most), 3));
    const material = new THREE.LineBasicMaterial({color: 0xd1495b, depthTest: false, transparent: true});
    const arc = new THREE.LineSegments(geometry, material);
    arc.frustumCulled = false;
    arc.renderOrder = 1;  // after the surfaces, which are transparent, too
    scene.add(arc);
    return arc;
  });

  const center = bounds.getCenter(new THREE.Vector3());
  controls.target.copy(center);
  const side = new THREE.Vector3().fromArray(report.up[2] ? [0, -1, 0] : [0, 0, 1]);
  camera.position.copy(center).addScaledVector(side, 1.7 * size).addScaledVector(camera.up, 0.3 * size);
  camera.near = size / 100;
  camera.far = size * 100;
  controls.update();

  function showPath(i, points, touched) {
    const position = lines[i].geometry.attributes.position;
    for (let k = 0; k < points.length; ++k) position.array[k] = points[k];
    position.needsUpdate = true;
    lines[i].geometry.setDrawRange(0, points.length / 3);
    const segments = arcs[i].geometry.attributes.position;
    let next = 0;
    touched.forEach(([first, last]) => {
      for (let k = first; k < last; ++k)
        for (let c = 0; c < 6; ++c) segments.array[next++] = points[3 * k + c];
    });
    segments.needsUpdate = true;
    arcs[i].geometry.setDrawRange(0, next / 3);
  }

  let current = -1;
  function show(index) {
    if (index === current) return;
    current = index;
    const frame = frames[index];
    bodies.forEach((body, b) => {
      const m = frame.bodies.subarray(12 * b, 12 * b + 12);
      body.matrix.set(m[0], m[3], m[6], m[9], m[1], m[4], m[7], m[10], m[2], m[5], m[8], m[11], 0, 0, 0, 1);
      body.matrixWorldNeedsUpdate = true;
    });
    surfaces.forEach((mesh, s) => mesh.material.color.setHex(frame.touched.includes(s) ? kTouched : kLifted));
    frame.paths.forEach((points, i) => showPath(i, points, frame.arcs[i]));
    find("slider").value = index;
    find("clock").value = frame.t.toFixed(3) + " s";
    if (chart) chart.draw();
    draw();
  }

  function draw() {
    const box = find("scene").getBoundingClientRect();
    if (renderer.domElement.width !== Math.floor(box.width * window.devicePixelRatio) ||
        renderer.domElement.height !== Math.floor(box.height * window.devicePixelRatio)) {
      renderer.setSize(box.width, box.height, false);
      camera.aspect = box.width / box.height;
      camera.updateProjectionMatrix();
    }
    renderer.render(scene, camera);
  }
  controls.addEventListener("change", draw);
  window.addEventListener("resize", () => { draw(); drawEvents(); });

  // ---- curves
  let chart = null;
  const cursor = {
    id: "cursor",
    afterDraw(owner) {
      const x = owner.scales.x.getPixelForValue(times[Math.max(current, 0)]);
      owner.ctx.save();
      owner.ctx.strokeStyle = "#222";
      owner.ctx.beginPath();
      owner.ctx.moveTo(x, owner.chartArea.top);
      owner.ctx.lineTo(x, owner.chartArea.bottom);
      owner.ctx.stroke();
      owner.ctx.restore();
    }
  };
  function showCurves(quantity) {
    const curves = report.curves.filter((curve) => curve.quantity === quantity);
    const datasets = curves.map((curve) => ({
      label: report.paths[curve.path].name + (curve.of ? " " + curve.of : ""),
      data: curve.values.map((y, i) => ({x: times[i], y: y})),
      borderColor: colors[curve.path], backgroundColor: colors[curve.path], borderWidth: 1.5, pointRadius: 0,
    }));
    if (chart) chart.destroy();
    chart = new Chart(find("chart"), {
      type: "line", data: {datasets: datasets}, plugins: [cursor],
      options: {
        animation: false, parsing: false, normalized: true, maintainAspectRatio: false, spanGaps: false,
        interaction: {mode: "nearest", axis: "x", intersect: false},
        scales: {x: {type: "linear", min: times[0], max: times[times.length - 1], title: {display: true, text: "time [s]"}},
                 y: {title: {display: true, text: quantity}}},
        plugins: {legend: {display: datasets.length <= 24, labels: {boxWidth: 12}}, tooltip: {enabled: datasets.length <= 24}},
        onClick: (event) => show(nearest(chart.scales.x.getValueForPixel(event.x))),
      },
    });
  }
  const quantities = [...new Set(report.curves.map((curve) => curve.quantity))];
  quantities.forEach((quantity) => find("quantity").add(new Option(quantity, quantity)));
  find("quantity").addEventListener("change", (event) => showCurves(event.target.value));

  // ---- time
  function nearest(time) {
    let best = 0;
    times.forEach((t, i) => { if (Math.abs(t - time) < Math.abs(times[best] - time)) best = i; });
    return best;
  }
  find("slider").max = frames.length - 1;
  find("slider").addEventListener("input", (event) => { stop(); show(Number(event.target.value)); });
  let startedAt = null, startedFrom = 0;
  function stop() {
    startedAt = null;
    find("play").textContent = "\u25b6";
  }
  function tick(now) {
    if (startedAt === null) return;
    const time = startedFrom + (now - startedAt) / 1000 * Number(find("speed").value);
    show(nearest(Math.min(time, times[times.length - 1])));
    if (time >= times[times.length - 1]) return stop();
    requestAnimationFrame(tick);
  }
  find("play").addEventListener("click", () => {
    if (startedAt !== null) return stop();
    find("play").textContent = "\u275a\u275a";
    startedAt = performance.now();
    startedFrom = current === frames.length - 1 ? times[0] : times[current];
    requestAnimationFrame(tick);
  });
  const kinds = {touchdown: "#2a9d8f", liftoff: "#e9a13b", slipped: "#d1495b", split: "#7b2d8b", left_hole: "#7b2d8b"};
  function drawEvents() {
    const canvas = find("events"), width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d");
    report.events.forEach((event) => {
      context.fillStyle = kinds[event.kind] || "#222";
      context.fillRect(8 + (width - 16) * (event.t - times[0]) / (duration || 1) - 1, 2, 2, height - 4);
    });
  }

  // ---- words
  document.querySelector("h1").textContent = report.title;
  find("summary").textContent = report.summary;
  const headings = ["path", "length [m]", "rate [m/s]", "tension [N]", "made", "lost", "slips", "degraded steps", "status"];
  document.querySelector("thead").innerHTML = "<tr>" + headings.map((h) => "<th>" + h + "</th>").join("") + "</tr>";
  report.table.forEach((row) => {
    const tr = document.createElement("tr");
    if (row.degraded > 0) tr.className = "bad";
    [row.name, row.length.toFixed(5), row.rate.toFixed(5), row.tension.toFixed(2), row.made, row.lost, row.slips,
     row.degraded, row.words].forEach((cell, i) => {
      const td = document.createElement("td");
      td.textContent = cell;
      if (i === 8) td.className = "words";
      tr.appendChild(td);
    });
    document.querySelector("tbody").appendChild(tr);
  });
  report.events.forEach((event) => {
    const link = document.createElement("a");
    link.textContent = event.t.toFixed(4) + " s: " + event.path + ", " + event.obstacle + ": " + event.kind;
    link.addEventListener("click", () => { stop(); show(nearest(event.t)); });
    find("eventlist").appendChild(link);
  });

  if (quantities.length) showCurves(quantities[0]);
  show(0);
  drawEvents();
  // For tests and the curious: what the page is made of.
  window.tautline = {show: show, scene: scene, lines: lines, surfaces: surfaces, getChart: () => chart, renderer: renderer};
})();
