'use strict';
// Meshes of bodies, joints and forces, and the numbers of a clip. `L` holds what the page uses of three.js and uPlot.

// Okabe and Ito's colours, without yellow and black: they are told apart by the colour-blind, too.
const PALETTE = ['#0072b2', '#d55e00', '#009e73', '#e69f00', '#cc79a7', '#56b4e9'];
const STEEL = '#6b7684';
const COIL_TURNS = 8;
const COIL_POINTS = 12 * COIL_TURNS;

/** Numbers of 32 bits from base64. */
function floats(text) {
  return new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
}

/** A clip with its numbers decoded: `poses`, `lines` and the like hold one row for each of the times `t`. */
function decodeClip(data) {
  return Object.fromEntries(Object.entries(data).map(([name, text]) => [name, floats(text)]));
}

/** The rows around a time, and the part of the way between them. */
function bracket(times, t) {
  let a = 0;
  let b = times.length - 1;
  while (b - a > 1) {
    const middle = (a + b) >> 1;
    if (times[middle] <= t) a = middle; else b = middle;
  }
  const part = (t - times[a]) / (times[b] - times[a] || 1);
  return [a, b, Math.min(1, Math.max(0, part))];
}

/** Value number `k` of rows of `width` numbers, between two rows. */
function mix(numbers, width, k, [a, b, part]) {
  const first = numbers[a * width + k];
  return first + part * (numbers[b * width + k] - first);
}

const vector = (numbers) => new L.Vector3(...numbers);
const Z = () => new L.Vector3(0, 0, 1);
const Y = () => new L.Vector3(0, 1, 0);

/** The layer of each body of a planar mechanism: bodies with a common joint lie in different ones. */
function layersOf(mechanism) {
  const layers = mechanism.bodies.map(() => -1);
  const neighbours = mechanism.bodies.map(() => new Set());
  for (const { bodies } of mechanism.joints) {
    for (const a of bodies) for (const b of bodies) if (a !== null && b !== null && a !== b) neighbours[a].add(b);
  }
  layers.forEach((_, body) => {
    const taken = new Set([...neighbours[body]].map((other) => layers[other]));
    let layer = 0;
    while (taken.has(layer)) layer += 1;
    layers[body] = layer;
  });
  return layers;
}

/** A link between two points with round ends, flat in the plane. */
function linkMesh(from, to, radius, material, isFlat) {
  const way = to.clone().sub(from);
  const mesh = new L.Mesh(new L.CapsuleGeometry(radius, way.length(), 6, 18), material);
  mesh.position.copy(from).addScaledVector(way, 0.5);
  mesh.quaternion.setFromUnitVectors(Y(), way.normalize());
  if (isFlat) mesh.scale.set(1.15, 1, 0.42);
  return mesh;
}

/** The hull of balls around points; of flat discs in the plane. */
function hullMesh(points, radius, material, isFlat) {
  const corners = [];
  for (const point of points) {
    for (let k = 0; k < 14; k += 1) {
      const angle = (2 * Math.PI * k) / 14;
      const heights = isFlat ? [-0.3, 0.3] : [-0.7, 0.7];
      for (const height of heights) {
        const width = isFlat ? 1 : 0.71;
        corners.push(vector([width * Math.cos(angle), width * Math.sin(angle), height]).multiplyScalar(radius).add(point));
      }
    }
    if (!isFlat) for (const height of [-1, 1]) corners.push(vector([0, 0, height * radius]).add(point));
  }
  const mesh = new L.Mesh(new L.ConvexGeometry(corners), material);
  return mesh;
}

/** True if points lie on a line, up to a small part of their distance. */
function areStraight(points) {
  const far = points.reduce((best, point) => (point.distanceTo(points[0]) > best.distanceTo(points[0]) ? point : best));
  const way = far.clone().sub(points[0]).normalize();
  return points.every((point) => point.clone().sub(points[0]).cross(way).length() < 1e-3 * far.distanceTo(points[0]));
}

/** The two points of a line that are farthest apart. */
function endsOfLine(points) {
  const from = points.reduce((best, point) => (point.distanceTo(points[0]) > best.distanceTo(points[0]) ? point : best));
  const to = points.reduce((best, point) => (point.distanceTo(from) > best.distanceTo(from) ? point : best));
  return [from, to];
}

/** A shape of the scene, which may have no thickness there. */
function solidMesh(solid, look, material) {
  const thin = look.isPlanar ? 0.5 * look.layer : 0.25 * look.radius;
  const thick = (size) => size || thin;
  let mesh;
  if (solid.box) mesh = new L.Mesh(new L.BoxGeometry(...solid.box.map(thick)), material);
  if (solid.sphere) mesh = new L.Mesh(new L.SphereGeometry(solid.sphere, 32, 20), material);
  if (solid.tube) mesh = tubeMesh(solid.tube[0], solid.tube[1], thick(solid.tube[2]), material);
  if (solid.polygon) mesh = prismMesh(solid.polygon[0], thick(solid.polygon[1]), material);
  if (solid.rod) {
    mesh = new L.Group();
    mesh.add(linkMesh(vector(solid.rod[0]), vector(solid.rod[1]), solid.rod[2] || 0.8 * look.radius, material, look.isPlanar));
  }
  mesh.position.set(...solid.at);
  mesh.quaternion.set(solid.rotation[1], solid.rotation[2], solid.rotation[3], solid.rotation[0]);
  if (look.isPlanar) flatten(mesh, 0.6 * look.layer);
  return mesh;
}

/** Makes a body of a planar scene no thicker than its layer. */
function flatten(mesh, thickness) {
  const size = new L.Box3().setFromObject(mesh).getSize(new L.Vector3());
  if (size.z > thickness) mesh.scale.z *= thickness / size.z;
}

function prismMesh(corners, thickness, material) {
  const outline = new L.Shape(corners.map(([x, y]) => new L.Vector2(x, y)));
  const geometry = new L.ExtrudeGeometry(outline, { depth: thickness, bevelEnabled: false });
  geometry.translate(0, 0, -0.5 * thickness);
  return new L.Mesh(geometry, material);
}

/** A hollow cylinder about z. */
function tubeMesh(outer, inner, length, material) {
  if (!inner) {
    const geometry = new L.CylinderGeometry(outer, outer, length, 40);
    geometry.rotateX(0.5 * Math.PI);
    return new L.Mesh(geometry, material);
  }
  const ring = new L.Shape().absarc(0, 0, outer, 0, 2 * Math.PI);
  ring.holes.push(new L.Shape().absarc(0, 0, inner, 0, 2 * Math.PI));
  const geometry = new L.ExtrudeGeometry(ring, { depth: length, bevelEnabled: false, curveSegments: 40 });
  geometry.translate(0, 0, -0.5 * length);
  return new L.Mesh(geometry, material);
}

/** Adds the fixed picture of a body: its shapes, else what its points outline. */
function addBody(group, body, look, material, plate) {
  if (body.solids.length) {
    body.solids.forEach((solid) => group.add(solidMesh(solid, look, material)));
    return;
  }
  const points = body.points.map((place) => vector(place.at));
  const flat = look.isPlanar;
  if (points.length === 1) {
    const size = 2.4 * look.radius;
    const geometry = body.oriented ? new L.BoxGeometry(2 * size, 2 * size, flat ? 0.6 * look.layer : 2 * size) : new L.SphereGeometry(size, 28, 18);
    const mesh = new L.Mesh(geometry, material);
    mesh.position.copy(points[0]);
    group.add(mesh);
  } else if (points.length > 1 && areStraight(points)) {
    group.add(linkMesh(...endsOfLine(points), look.radius, material, flat));
    if (!body.oriented) addBall(group, points[points.length - 1], 2.4 * look.radius, material);
  } else if (points.length > 2) {
    group.add(hullMesh(points, look.radius, plate, flat));
    if (points.length <= 4) addFrame(group, points, look, material);
  }
}

/** Links between all points of a body. */
function addFrame(group, points, look, material) {
  points.forEach((from, i) => points.slice(i + 1).forEach((to) => {
    group.add(linkMesh(from, to, 0.62 * look.radius, material, look.isPlanar));
  }));
}

function addBall(group, at, radius, material) {
  const ball = new L.Mesh(new L.SphereGeometry(radius, 24, 16), material);
  ball.position.copy(at);
  group.add(ball);
  return ball;
}

function rotationOf(place) {
  const [w, x, y, z] = place.rotation || [1, 0, 0, 0];
  return new L.Quaternion(x, y, z, w);
}

/** A cylinder along an axis, centred at the origin. */
function pin(axis, radius, length, material) {
  const mesh = new L.Mesh(new L.CylinderGeometry(radius, radius, length, 24), material);
  mesh.quaternion.setFromUnitVectors(Y(), axis.clone().normalize());
  return mesh;
}

function ring(axis, radius, width, material, arc = 2 * Math.PI) {
  const mesh = new L.Mesh(new L.TorusGeometry(radius, width, 12, 56, arc), material);
  mesh.quaternion.setFromUnitVectors(Z(), axis.clone().normalize());
  return mesh;
}

/** A bar along an axis from `low` to `high`. */
function rail(axis, low, high, look, material) {
  const group = new L.Group();
  const side = new L.Vector3().crossVectors(axis, Math.abs(axis.z) < 0.9 ? Z() : Y()).normalize();
  for (const sign of [-1, 1]) {
    const mesh = pin(axis, 0.28 * look.radius, high - low + 6 * look.radius, material);
    mesh.position.copy(axis).multiplyScalar(0.5 * (low + high)).addScaledVector(side, 2 * sign * look.radius);
    group.add(mesh);
  }
  return group;
}

// The picture of each kind of joint: fixed parts in the frame of its first end, and in that of its second end.
// `axis` is a unit vector in the axes of the first end; `travel` the range of the second end along it.
const JOINTS = {
  revolute: ({ axis, look, material }) => [[pin(axis, 0.75 * look.radius, look.isPlanar ? look.depth : 5 * look.radius, material)], []],
  spherical: ({ look, material }) => [[addBall(new L.Group(), new L.Vector3(), 1.7 * look.radius, material)], []],
  universal: ({ look, material }) => [[pin(new L.Vector3(1, 0, 0), 0.6 * look.radius, 6 * look.radius, material)], [pin(Y(), 0.6 * look.radius, 6 * look.radius, material)]],
  prismatic: (joint) => [[rail(joint.axis, ...joint.travel, joint.look, joint.material)], [block(joint)]],
  cylindrical: (joint) => [[rail(joint.axis, ...joint.travel, joint.look, joint.material)], [addBall(new L.Group(), new L.Vector3(), 1.5 * joint.look.radius, joint.material)]],
  point_on_line: (joint) => [[rail(joint.axis, ...joint.travel, joint.look, joint.material)], [addBall(new L.Group(), new L.Vector3(), 1.3 * joint.look.radius, joint.material)]],
  planar: ({ axis, look, material }) => [[patch(axis, look, material)], [addBall(new L.Group(), new L.Vector3(), look.radius, material)]],
  weld: ({ look, material }) => [[new L.Mesh(new L.BoxGeometry(2.3 * look.radius, 2.3 * look.radius, 2.3 * look.radius), material)], []],
  gear: ({ radii, look, material }) => (radii.length ? radii.map((radius) => [wheelOf(radius, look, material)]) : [[], []]),
  driver: ({ axis, look, material }) => [axis ? [ring(axis, 2.6 * look.radius, 0.32 * look.radius, material, 4.6)] : [], []],
  distance: () => [[], []],
};

function block({ axis, look, material }) {
  const mesh = new L.Mesh(new L.BoxGeometry(2.6 * look.radius, 4 * look.radius, 2.6 * look.radius), material);
  mesh.quaternion.setFromUnitVectors(Y(), axis);
  return mesh;
}

function patch(axis, look, material) {
  const mesh = new L.Mesh(new L.BoxGeometry(9 * look.radius, 9 * look.radius, 0.3 * look.radius), material);
  mesh.quaternion.setFromUnitVectors(Z(), axis);
  return mesh;
}

/** A pitch circle with a spoke, which shows how it turns. */
function wheelOf(radius, look, material) {
  const wheel = new L.Group();
  wheel.add(ring(Z(), radius, 0.4 * look.radius, material));
  wheel.add(pin(new L.Vector3(1, 0, 0), 0.3 * look.radius, 2 * radius, material));
  return wheel;
}

function diamond({ look, material }) {
  return [[new L.Mesh(new L.OctahedronGeometry(1.5 * look.radius), material)], []];
}

/** Points of a coil with straight ends from one place to another, which keeps its turns when it is stretched. */
function coilPoints(from, to, radius) {
  const way = to.clone().sub(from);
  const along = way.clone().normalize();
  const first = new L.Vector3().crossVectors(along, Math.abs(along.z) < 0.9 ? Z() : Y()).normalize();
  const second = new L.Vector3().crossVectors(along, first);
  const points = [from.clone()];
  for (let k = 0; k <= COIL_POINTS; k += 1) {
    const angle = (2 * Math.PI * COIL_TURNS * k) / COIL_POINTS;
    const point = from.clone().addScaledVector(way, 0.12 + (0.76 * k) / COIL_POINTS);
    points.push(point.addScaledVector(first, radius * Math.cos(angle)).addScaledVector(second, radius * Math.sin(angle)));
  }
  return [...points, to.clone()];
}

/** A spiral in the x-y plane. */
function spiralMesh(look, material) {
  const points = [];
  for (let k = 0; k <= 80; k += 1) {
    const angle = (5 * Math.PI * k) / 80;
    points.push(vector([Math.cos(angle), Math.sin(angle), 0]).multiplyScalar(look.radius * (1 + (2.4 * k) / 80)));
  }
  return new L.Mesh(new L.TubeGeometry(new L.CatmullRomCurve3(points), 120, 0.25 * look.radius, 6), material);
}

/** A tyre with spokes about the y axis of its hub, in the plane about z. */
function tyreMesh(radius, look, material, rim) {
  const wheel = new L.Group();
  const rubber = new L.Mesh(new L.TorusGeometry(0.84 * radius, 0.16 * radius, 18, 64), material);
  if (look.isPlanar) rubber.scale.z = Math.min(1, (0.8 * look.layer) / (0.16 * radius));
  wheel.add(rubber);
  for (let k = 0; k < 3; k += 1) {
    const angle = (Math.PI * k) / 3;
    wheel.add(pin(vector([Math.cos(angle), Math.sin(angle), 0]), 0.5 * look.radius, 1.5 * radius, rim));
  }
  if (!look.isPlanar) wheel.rotation.x = 0.5 * Math.PI;
  return wheel;
}

/** Points of a mesh around a line that moves. */
class Tube {
  constructor(points, radius, material, sides = 10) {
    this.sides = sides;
    this.radius = radius;
    const geometry = new L.BufferGeometry();
    geometry.setAttribute('position', new L.BufferAttribute(new Float32Array(3 * points * this.sides), 3));
    const index = [];
    for (let k = 0; k + 1 < points; k += 1) {
      for (let s = 0; s < this.sides; s += 1) {
        const [a, b] = [k * this.sides + s, k * this.sides + ((s + 1) % this.sides)];
        index.push(a, a + this.sides, b, b, a + this.sides, b + this.sides);
      }
    }
    geometry.setIndex(index);
    this.mesh = new L.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  follow(points) {
    const position = this.mesh.geometry.attributes.position;
    let first = null;
    points.forEach((point, k) => {
      const way = points[Math.min(k + 1, points.length - 1)].clone().sub(points[Math.max(k - 1, 0)]).normalize();
      // Each ring is turned as little as possible against the one before.
      first = first ? first.addScaledVector(way, -first.dot(way)).normalize() : new L.Vector3().crossVectors(way, Math.abs(way.z) < 0.9 ? Z() : Y()).normalize();
      const second = new L.Vector3().crossVectors(way, first);
      for (let s = 0; s < this.sides; s += 1) {
        const angle = (2 * Math.PI * s) / this.sides;
        const [c, d] = [this.radius * Math.cos(angle), this.radius * Math.sin(angle)];
        position.setXYZ(k * this.sides + s, point.x + c * first.x + d * second.x, point.y + c * first.y + d * second.y, point.z + c * first.z + d * second.z);
      }
    });
    position.needsUpdate = true;
    this.mesh.geometry.computeVertexNormals();
  }
}

/** An object of length 1 along y that reaches from one place to another. */
function stretch(object, from, to) {
  const way = to.clone().sub(from);
  const length = way.length();
  object.position.copy(from);
  object.scale.y = Math.max(length, 1e-9);
  object.quaternion.setFromUnitVectors(Y(), length > 1e-9 ? way.divideScalar(length) : Y());
}

function rodGeometry(radius) {
  const geometry = new L.CylinderGeometry(radius, radius, 1, 14);
  geometry.translate(0, 0.5, 0);
  return geometry;
}

/** Position of a place at the present poses. */
function where(mechanism, place) {
  return vector(place.at).applyMatrix4(mechanism.frames[place.frame].matrixWorld);
}

/** Position of a place at a row of a clip. */
function placeAt(clip, isPlanar, place, rows) {
  const pose = poseAt(clip, isPlanar, place.frame, rows);
  return vector(place.at).applyQuaternion(pose.quaternion).add(pose.position);
}

/** Pose of a frame between two rows; frame 0 is the ground. */
function poseAt(clip, isPlanar, frame, rows) {
  const position = new L.Vector3();
  const quaternion = new L.Quaternion();
  if (frame === 0) return { position, quaternion };
  const size = isPlanar ? 3 : 7;
  const width = clip.poses.length / clip.t.length;
  const first = (frame - 1) * size;
  const [a, b, part] = rows;
  if (isPlanar) {
    position.set(mix(clip.poses, width, first, rows), mix(clip.poses, width, first + 1, rows), 0);
    const angle = clip.poses[a * width + first + 2];
    const turn = clip.poses[b * width + first + 2] - angle;
    // The shorter way round.
    const way = turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    quaternion.setFromAxisAngle(Z(), angle + part * way);
  } else {
    position.set(...[0, 1, 2].map((k) => mix(clip.poses, width, first + k, rows)));
    const end = new L.Quaternion();
    quaternion.fromArray(clip.poses, a * width + first + 3);
    quaternion.slerp(end.fromArray(clip.poses, b * width + first + 3), part);
  }
  return { position, quaternion };
}
