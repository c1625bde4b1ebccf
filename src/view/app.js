// Joins the picture and the curves with the camera, the clock and the controls.

const byId = (id) => document.getElementById(id);
const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];

/** Unpacks the libraries into a script of their own. */
async function loadLibraries() {
  const packed = Uint8Array.from(atob(byId('libraries').textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const script = document.createElement('script');
  script.textContent = `${await new Response(stream).text()};globalThis.L=L;`;
  document.head.append(script);
}

/** The size of the scene over the motion, from which all widths follow. */
function lookOf(data, clip) {
  const isPlanar = data.dimension === 2;
  const points = [];
  const links = [];
  const first = data.mechanisms[0];
  const places = [...first.bodies.flatMap((body) => body.points), ...first.joints.flatMap((joint) => joint.ends), ...first.forces.flatMap((force) => force.ends)];
  for (let row = 0; row < clip.t.length; row += Math.max(1, clip.t.length >> 6)) {
    places.forEach((place) => points.push(placeAt(clip, isPlanar, place, [row, row, 0])));
  }
  points.push(...pointsOfLines(clip, isPlanar));
  for (const force of first.forces.filter((one) => one.kind === 'tyre')) points.push(...cornersOfTyre(force, clip, isPlanar));
  const box = new L.Box3().setFromPoints(points.length ? points : [new L.Vector3()]);
  for (const body of first.bodies) {
    if (body.points.length > 1) links.push(new L.Box3().setFromPoints(body.points.map((place) => vector(place.at))).getSize(new L.Vector3()).length());
  }
  if (box.getSize(new L.Vector3()).length() < 1e-9) box.expandByScalar(0.5);
  const size = box.getSize(new L.Vector3()).length();
  links.sort((a, b) => a - b);
  const usual = links.length ? links[links.length >> 1] : size;
  const radius = Math.min(0.014 * size, Math.max(0.0035 * size, 0.035 * usual));
  const layer = 1.7 * radius;
  const depth = layer * (1 + Math.max(0, ...layersOf(first)));
  return { isPlanar, points, box, size, radius, layer, depth, up: data.up, isDark: darkMode.matches };
}

function pointsOfLines(clip, isPlanar) {
  const step = isPlanar ? 2 : 3;
  const points = [];
  for (let i = 0; i + step <= clip.lines.length; i += 4 * step) {
    points.push(new L.Vector3(clip.lines[i], clip.lines[i + 1], isPlanar ? 0 : clip.lines[i + 2]));
  }
  return points;
}

/** The farthest points of a tyre at the start and the end. */
function cornersOfTyre(force, clip, isPlanar) {
  const rows = [0, clip.t.length - 1];
  const ways = [0, 1, 2].slice(0, isPlanar ? 2 : 3).flatMap((i) => [-1, 1].map((sign) => new L.Vector3().setComponent(i, sign * force.radii[0])));
  return rows.flatMap((row) => ways.map((way) => placeAt(clip, isPlanar, force.ends[0], [row, row, 0]).add(way)));
}

const darkMode = matchMedia('(prefers-color-scheme: dark)');

/** The page: its data, its picture, and the time that it shows. */
class Page {
  constructor(data) {
    this.data = data;
    this.clips = data.mechanisms.map((one) => decodeClip(one.clip));
    this.modes = data.modes.map((mode) => ({ ...mode, clip: decodeClip(mode.clip) }));
    this.mode = null;
    this.t = this.start;
    this.playing = true;
    this.frames = 0;
    this.traces = [];
    // Numbers of the runs that are not shown.
    this.hidden = new Set();
    this.follows = '';
  }

  get start() { return this.clips[0].t[0]; }

  get end() { return this.clips[0].t.at(-1); }

  isDark() { return darkMode.matches; }

  /** Goes to a time, and stays there. */
  seek(t) {
    this.t = Math.min(this.end, Math.max(this.start, t));
    this.setPlaying(false);
    this.changed = true;
  }

  setPlaying(playing) {
    this.playing = playing;
    byId('play').textContent = playing ? 'Pause' : 'Play';
  }
}

/** Makes the scene with light, grid and mechanisms; again when the colours of the system change. */
function buildScene(page) {
  page.look = lookOf(page.data, page.clips[0]);
  page.scene = new L.Scene();
  page.scene.add(new L.HemisphereLight('#ffffff', page.look.isDark ? '#55606e' : '#a9b2bd', 2.1));
  page.sun = new L.DirectionalLight('#ffffff', 1.7);
  page.scene.add(page.sun);
  addGrid(page);
  page.mechanisms = page.data.mechanisms.map((data, k) => {
    const mechanism = buildMechanism(data, page.clips[k], page.look, k > 0 ? ghostColor(k) : null);
    page.scene.add(mechanism.root);
    return mechanism;
  });
  page.traces.forEach((trace) => drawTrace(page, trace));
  page.changed = true;
}

/** A grid with cells of 1, 2 or 5 times a power of ten: behind a planar mechanism, below one in space. */
function addGrid(page) {
  const { look } = page;
  const power = 10 ** Math.floor(Math.log10(look.size / 12));
  const cell = power * [1, 2, 5, 10].find((digit) => digit * power >= look.size / 12);
  const count = 2 * Math.ceil((1.1 * look.size) / cell);
  const grid = new L.GridHelper(count * cell, count, look.isDark ? '#3c4857' : '#bfc7d1', look.isDark ? '#222a34' : '#dfe4ea');
  const middle = look.box.getCenter(new L.Vector3());
  grid.position.copy(middle.divideScalar(cell).round().multiplyScalar(cell));
  if (look.isPlanar) {
    grid.rotation.x = 0.5 * Math.PI;
    grid.position.z = -1.2 * look.layer;
  } else {
    const low = look.box.min.getComponent(look.up);
    grid.position.setComponent(look.up, Math.abs(low) < 0.25 * look.size ? Math.min(0, low) : low);
    if (look.up === 2) grid.rotation.x = 0.5 * Math.PI;
    if (look.up === 0) grid.rotation.z = 0.5 * Math.PI;
  }
  grid.userData.isGrid = true;
  page.scene.add(grid);
  byId('grid').textContent = `grid ${short(cell)} m`;
}

function buildCamera(page) {
  const view = byId('view');
  page.renderer = new L.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  page.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  view.prepend(page.renderer.domElement);
  page.camera = new L.PerspectiveCamera(30, 1, 1e-3, 1e4);
  page.camera.up.setComponent(0, 0).setComponent(1, 0).setComponent(2, 0).setComponent(page.look.isPlanar ? 1 : page.look.up, 1);
  page.controls = new L.OrbitControls(page.camera, page.renderer.domElement);
  page.controls.enableDamping = true;
  page.controls.dampingFactor = 0.12;
  page.controls.addEventListener('change', () => { page.changed = true; });
}

/** Directions to the viewer, right of `up` and behind it in the order of the axes. */
function viewDirections(look) {
  const unit = (i) => new L.Vector3().setComponent(i % 3, 1);
  if (look.isPlanar) return { front: unit(2), side: unit(0), top: unit(1), iso: new L.Vector3(-0.28, 0.2, 1) };
  const [first, second, up] = [unit(look.up + 1), unit(look.up + 2), unit(look.up)];
  const iso = first.clone().multiplyScalar(0.75).addScaledVector(second, -1).addScaledVector(up, 0.55);
  return { front: second.clone().negate(), side: first, top: up, iso };
}

/** Looks at the whole mechanism from a direction. */
function lookFrom(page, direction) {
  const { camera, controls, look } = page;
  const way = direction.clone().normalize();
  // Exactly from above, up has no direction in the picture.
  if (Math.abs(way.dot(camera.up)) > 0.999) way.addScaledVector(viewDirections(look).front, 1e-3).normalize();
  const back = way.clone();
  const right = new L.Vector3().crossVectors(camera.up, back).normalize();
  const above = new L.Vector3().crossVectors(back, right);
  const slope = Math.tan((camera.fov * Math.PI) / 360);
  const middle = look.box.getCenter(new L.Vector3());
  // The buttons above hide nothing.
  const free = Math.max(0.5, 1 - 84 / byId('view').clientHeight);
  let distance = 0;
  for (const place of look.points) {
    const point = place.clone().sub(middle);
    const high = Math.abs(point.dot(above)) / (slope * free);
    const wide = Math.abs(point.dot(right)) / (slope * camera.aspect);
    distance = Math.max(distance, point.dot(back) + Math.max(high, wide));
  }
  distance = Math.max(1.08 * distance, 0.2 * look.size);
  controls.target.copy(middle);
  camera.position.copy(middle).addScaledVector(back, distance);
  camera.near = look.size / 500;
  camera.far = 60 * look.size;
  camera.updateProjectionMatrix();
  controls.update();
  page.changed = true;
}

function resize(page) {
  const { clientWidth, clientHeight } = byId('view');
  if (page.renderer) {
    page.renderer.setSize(clientWidth, clientHeight, false);
    page.camera.aspect = clientWidth / Math.max(1, clientHeight);
    page.camera.updateProjectionMatrix();
  }
  if (page.curves.plot) page.curves.plot.setSize(plotSize());
  page.changed = true;
}

/** A path of a point over the whole motion. */
function drawTrace(page, trace) {
  const clip = page.clips[0];
  const height = page.look.isPlanar ? page.look.depth : 0;
  const points = Array.from(clip.t, (_, row) => placeAt(clip, page.look.isPlanar, trace.place, [row, row, 0])).map((point) => (height ? point.setZ(height) : point));
  const color = trace.body === null ? STEEL : PALETTE[trace.body % PALETTE.length];
  trace.line = new L.Line(new L.BufferGeometry().setFromPoints(points), new L.LineBasicMaterial({ color }));
  trace.line.userData.name = `path of ${trace.name}`;
  trace.line.visible = byId('traces').checked;
  page.scene.add(trace.line);
}

/** What the pointer is over: the nearest part with a name. */
function hit(page, event) {
  const box = byId('view').getBoundingClientRect();
  const pointer = new L.Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
  const ray = new L.Raycaster();
  ray.setFromCamera(pointer, page.camera);
  ray.params.Line.threshold = 0.3 * page.look.radius;
  return ray.intersectObjects(page.scene.children, true).find((one) => one.object.visible && one.object.userData.name);
}

function showTip(page, event) {
  const tip = byId('tip');
  const found = event.buttons ? null : hit(page, event);
  tip.style.display = found ? 'block' : 'none';
  if (!found) return;
  const box = byId('view').getBoundingClientRect();
  tip.textContent = found.object.userData.name;
  tip.style.left = `${Math.min(event.clientX - box.left + 12, box.width - tip.offsetWidth - 4)}px`;
  tip.style.top = `${event.clientY - box.top + 12}px`;
}

/** Adds the path of the point under the pointer, or removes a path there. */
function toggleTrace(page, event) {
  const found = hit(page, event);
  if (!found) return;
  const known = page.traces.find((trace) => trace.line === found.object);
  if (known) {
    page.scene.remove(known.line);
    page.traces.splice(page.traces.indexOf(known), 1);
  } else {
    const [mechanism] = page.mechanisms;
    let frame = -1;
    for (let object = found.object; object && frame < 0; object = object.parent) frame = mechanism.frames.indexOf(object);
    if (frame < 1) return;
    const at = mechanism.frames[frame].worldToLocal(found.point.clone()).toArray();
    const trace = { name: found.object.userData.name, body: mechanism.data.bodies.findIndex((body) => body.frame === frame), place: { frame, at } };
    page.traces.push(trace);
    drawTrace(page, trace);
  }
  page.changed = true;
}

/** Position of a body at the present pose. */
function bodyPosition(page, name) {
  const [mechanism] = page.mechanisms;
  const body = mechanism.data.bodies.find((one) => one.name === name);
  return new L.Vector3().setFromMatrixPosition(mechanism.frames[body ? body.frame : 0].matrixWorld);
}

/** Moves the camera with the body that it follows. */
function follow(page) {
  if (!page.follows) return;
  const position = bodyPosition(page, page.follows);
  const way = position.clone().sub(page.followed || position);
  page.followed = position;
  page.controls.target.add(way);
  page.camera.position.add(way);
}

/** Writes the names of the bodies at their places. */
function showNames(page) {
  const labels = byId('labels');
  const { bodies } = page.data.mechanisms[0];
  const shown = byId('names').checked ? bodies.filter((body) => body.frame > 0) : [];
  while (labels.children.length > shown.length) labels.lastChild.remove();
  while (labels.children.length < shown.length) labels.append(document.createElement('span'));
  const { clientWidth, clientHeight } = byId('view');
  shown.forEach((body, k) => {
    const at = bodyPosition(page, body.name).project(page.camera);
    const label = labels.children[k];
    label.textContent = body.name;
    label.style.left = `${(0.5 + 0.5 * at.x) * clientWidth}px`;
    label.style.top = `${(0.5 - 0.5 * at.y) * clientHeight}px`;
  });
}

/** Moves everything to the present time. */
function show(page) {
  const clip = page.mode ? page.mode.clip : page.clips[0];
  const phase = page.mode ? page.phase : page.t;
  page.mechanisms.forEach((mechanism, k) => {
    mechanism.root.visible = !page.hidden.has(k) && (k === 0 || !page.mode);
    poseMechanism(mechanism, phase, k === 0 ? clip : undefined);
  });
  const most = byId('loads').checked && !page.mode ? page.mostForce : 0;
  colorJoints(page.mechanisms[0], page.t, most);
  byId('time').value = page.t;
  byId('clock').textContent = clockText(page.t);
  moveCursor(page.curves);
}

function clockText(t) {
  return t === null || t === undefined ? '–' : `${(Math.abs(t) < 5e-13 ? 0 : t).toFixed(clockText.decimals)} s`;
}

/** Seconds of the scene in a second of the page at speed 1: real time, or what shows the motion in 6 s. */
function usualSpeed(length) {
  if (length >= 2 && length <= 20) return 1;
  const power = 10 ** Math.floor(Math.log10(length / 6));
  return power * [1, 2, 5, 10].find((digit) => digit * power >= 0.999 * (length / 6));
}

function speedText(speed) {
  if (Math.abs(speed - 1) < 1e-9) return 'real time';
  return speed < 1 ? `${short(1 / speed)} × slower` : `${short(speed)} × faster`;
}

/** One picture of the animation. */
function tick(page, now) {
  const passed = Math.min(0.1, (now - (page.last || now)) / 1000);
  page.last = now;
  if (page.mode && page.playing) {
    // A shape without an oscillation is shown at the same pace.
    page.phase = (page.phase + passed * 0.6 * Number(byId('speed').value)) % 1;
    page.changed = true;
  } else if (page.playing && page.end > page.start) {
    page.t += passed * page.pace * Number(byId('speed').value);
    if (page.t > page.end) page.t = page.start;
    page.changed = true;
  }
  page.controls.update();
  if (page.changed) draw(page);
  page.frames += 1;
}

function draw(page) {
  page.changed = false;
  show(page);
  follow(page);
  page.sun.position.copy(page.camera.position).addScaledVector(page.camera.up, 0.6 * page.look.size);
  page.renderer.render(page.scene, page.camera);
  showNames(page);
}

/** Fills the list of speeds, for the motion or for a mode. */
function fillSpeeds(page) {
  const list = byId('speed');
  const chosen = list.selectedIndex < 0 ? SPEEDS.indexOf(1) : list.selectedIndex;
  const pace = page.mode ? 0.6 / (page.mode.frequency || 0.6) : page.pace;
  list.replaceChildren(...SPEEDS.map((factor) => new Option(page.mode && !page.mode.frequency ? `${factor} ×` : speedText(factor * pace), factor)));
  list.selectedIndex = chosen;
}

function chooseMode(page, number) {
  page.mode = number === null ? null : page.modes[number];
  page.phase = 0;
  byId('mode-label').textContent = page.mode ? page.mode.label : '';
  ['mode', 'mode-label'].forEach((id) => { byId(id).hidden = !page.mode; });
  ['time', 'clock'].forEach((id) => { byId(id).hidden = Boolean(page.mode); });
  fillSpeeds(page);
  page.changed = true;
}

/** Connects the buttons and lists. */
function connect(page) {
  byId('play').onclick = () => page.setPlaying(!page.playing);
  byId('time').oninput = () => page.seek(Number(byId('time').value));
  byId('loads').onchange = () => { byId('scale').classList.toggle('on', byId('loads').checked); page.changed = true; };
  byId('names').onchange = () => { page.changed = true; };
  byId('traces').onchange = () => { page.traces.forEach((trace) => { trace.line.visible = byId('traces').checked; }); page.changed = true; };
  byId('joints').onchange = () => {
    page.mechanisms.forEach((one) => one.joints.forEach((joint) => joint.objects.forEach((object) => { object.visible = byId('joints').checked; })));
    page.changed = true;
  };
  byId('follow').append(...page.data.mechanisms[0].bodies.filter((body) => body.frame > 0).map((body) => new Option(body.name)));
  byId('follow').onchange = () => { page.follows = byId('follow').value; page.followed = null; page.changed = true; };
  byId('mode-kind').hidden = !page.modes.length;
  byId('mode').max = page.modes.length - 1;
  byId('mode').oninput = () => chooseMode(page, Number(byId('mode').value));
  byId('mode-kind').onchange = () => {
    chooseMode(page, byId('mode-kind').value ? Number(byId('mode').value) : null);
    page.setPlaying(true);
  };
  byId('picture').onclick = () => savePicture(page);
  document.querySelectorAll('[data-view]').forEach((button) => { button.onclick = () => goTo(page, button.dataset.view); });
  const { domElement } = page.renderer;
  domElement.addEventListener('pointermove', (event) => showTip(page, event));
  domElement.addEventListener('pointerleave', () => { byId('tip').style.display = 'none'; });
  domElement.addEventListener('dblclick', (event) => toggleTrace(page, event));
}

function goTo(page, view) {
  const direction = view === 'fit' ? page.camera.position.clone().sub(page.controls.target) : viewDirections(page.look)[view];
  lookFrom(page, direction);
}

function savePicture(page) {
  const link = document.createElement('a');
  link.href = page.renderer.domElement.toDataURL('image/png');
  link.download = 'mechanism.png';
  link.click();
}

function onKey(page, event) {
  if (event.ctrlKey || event.metaKey || event.altKey || ['INPUT', 'SELECT', 'TEXTAREA'].includes(event.target.tagName) && event.target.type !== 'checkbox') return;
  const step = (page.end - page.start) / 200 * (event.shiftKey ? 10 : 1);
  const actions = {
    ' ': () => page.setPlaying(!page.playing),
    ArrowRight: () => page.seek(page.t + step),
    ArrowLeft: () => page.seek(page.t - step),
    Home: () => page.seek(page.start),
    End: () => page.seek(page.end),
    f: () => goTo(page, 'front'),
    s: () => goTo(page, 'side'),
    t: () => goTo(page, 'top'),
    i: () => goTo(page, 'iso'),
    a: () => goTo(page, 'fit'),
  };
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

/** Writes names, notes and scales, which come from the scene, as text. */
function fillTexts(page) {
  const { data } = page;
  document.title = `${data.name} – holonom`;
  byId('name').textContent = data.name;
  byId('about').textContent = data.about;
  byId('about').title = data.about;
  byId('notes').replaceChildren(...data.notes.map((note) => Object.assign(document.createElement('li'), { textContent: note })));
  byId('ghosts').replaceChildren(...(data.mechanisms.length > 1 ? data.mechanisms : []).map((one, k) => ghostLine(page, one.label, k)));
  page.mostForce = largest(page.clips[0].reactions);
  byId('loads-label').style.display = page.mostForce > 0 ? '' : 'none';
  const [factor, unit] = page.mostForce >= 1e6 ? [1e-6, 'MN'] : page.mostForce >= 1e3 ? [1e-3, 'kN'] : [1, 'N'];
  byId('scale-top').textContent = `${short(page.mostForce * factor)} ${unit}`;
  document.querySelector('#scale i').style.background = `linear-gradient(90deg, ${SCALE.join(', ')})`;
  const length = page.end - page.start;
  clockText.decimals = Math.min(9, Math.max(2, 3 - Math.floor(Math.log10(length || 1))));
  page.pace = usualSpeed(length || 1);
  Object.assign(byId('time'), { min: page.start, max: page.end });
}

/** Name and colour of one of several runs, with a switch. */
function ghostLine(page, name, k) {
  const line = document.createElement('label');
  const box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: true });
  const color = document.createElement('i');
  color.style.background = k > 0 ? ghostColor(k) : STEEL;
  box.onchange = () => {
    page.hidden[box.checked ? 'delete' : 'add'](k);
    page.changed = true;
  };
  line.append(box, color, name);
  return line;
}

const ghostColor = (k) => PALETTE[(k + 2) % PALETTE.length];

/** Starts the page: texts and curves first, which need no WebGL, then the picture. */
function start() {
  const page = new Page(JSON.parse(byId('data').textContent));
  globalThis.holonom = page;
  fillTexts(page);
  page.curves = buildCurves(page, page.data, page.clips[0].t);
  page.traces = page.data.mechanisms[0].traces.map((trace) => ({ ...trace }));
  buildScene(page);
  try {
    buildCamera(page);
  } catch (error) {
    trouble('This browser draws no WebGL, so that the mechanism is not shown. Its curves are below.');
    return;
  }
  connect(page);
  // A page of a linear model alone has no motion but its modes.
  const hasModesAlone = page.modes.length > 0 && page.end <= page.start;
  byId('mode-kind').value = hasModesAlone ? 'modes' : '';
  chooseMode(page, hasModesAlone ? 0 : null);
  page.setPlaying(page.playing);
  resize(page);
  goTo(page, 'iso');
  addEventListener('resize', () => resize(page));
  addEventListener('keydown', (event) => onKey(page, event));
  darkMode.addEventListener('change', () => { buildScene(page); drawCurves(page.curves); });
  page.renderer.setAnimationLoop((now) => tick(page, now));
}

function trouble(text) {
  byId('trouble').textContent = text;
  byId('trouble').style.display = 'block';
}

loadLibraries().then(start).catch((error) => {
  trouble(`The page could not be shown: ${error.message}. It needs a browser of 2023 or later.`);
  throw error;
});
