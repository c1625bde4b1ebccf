// The picture of one mechanism: `buildMechanism` makes its objects, `poseMechanism` moves them to a time of a clip.

/** Number of values in each row of a clip. */
const rowWidth = (clip, numbers) => numbers.length / clip.t.length;

/** The largest size of some numbers; 0 without any. */
function largest(numbers) {
  return numbers.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
}

/** A material; ghosts have one pale colour. */
function paint(color, look, ghost, opacity = 1) {
  const alpha = ghost ? 0.28 : opacity;
  return new L.MeshStandardMaterial({
    color: ghost || color, roughness: 0.55, metalness: 0.08, transparent: alpha < 1, opacity: alpha, depthWrite: alpha === 1, side: L.DoubleSide,
  });
}

/** The range of the second end of a sliding joint along its axis. */
function travelOf(joint, axis, clip, look) {
  const all = [];
  for (let row = 0; row < clip.t.length; row += Math.max(1, clip.t.length >> 7)) {
    const from = placeAt(clip, look.isPlanar, joint.ends[0], [row, row, 0]);
    const to = placeAt(clip, look.isPlanar, joint.ends[1], [row, row, 0]);
    const turn = poseAt(clip, look.isPlanar, joint.ends[0].frame, [row, row, 0]).quaternion;
    const along = axis.clone().applyQuaternion(rotationOf(joint.ends[0])).applyQuaternion(turn);
    all.push(to.sub(from).dot(along));
  }
  return [Math.min(...all), Math.max(...all)];
}

/** All objects of a mechanism, in `root`. */
function buildMechanism(data, clip, look, ghost) {
  const root = new L.Group();
  const count = rowWidth(clip, clip.poses) / (look.isPlanar ? 3 : 7);
  const frames = Array.from({ length: count + 1 }, () => root.add(new L.Group()).children.at(-1));
  const mechanism = { data, root, frames, look, clip, moving: [], springs: [], joints: [], lines: [], roads: [], arrows: [], layers: layersOf(data) };
  mechanism.largestForce = largest(clip.arrows || []) || 1;
  data.bodies.forEach((body, number) => addBodyObjects(mechanism, body, number, ghost));
  const steel = paint(look.isDark ? '#aeb8c4' : STEEL, look, ghost);
  data.joints.forEach((joint) => addJoint(mechanism, joint, ghost));
  data.forces.forEach((force) => addForce(mechanism, force, steel, ghost));
  if (!ghost) addGround(mechanism, steel);
  return mechanism;
}

/** Height of a body's layer in a planar scene. */
function heightOf(mechanism, body) {
  return mechanism.look.isPlanar && body !== null ? mechanism.layers[body] * mechanism.look.layer : 0;
}

function addBodyObjects(mechanism, body, number, ghost) {
  const { look } = mechanism;
  const color = PALETTE[number % PALETTE.length];
  const material = paint(color, look, ghost);
  if (body.line) {
    const tube = new Tube(body.line, 0.8 * look.radius, material);
    label(tube.mesh, body.name);
    mechanism.root.add(tube.mesh);
    mechanism.lines.push({ tube, count: body.line, height: heightOf(mechanism, number) });
    return;
  }
  if (new Set(body.points.map((place) => place.frame)).size > 1) {
    addDeformedBody(mechanism, body, material);
    return;
  }
  const group = new L.Group();
  addBody(group, body, look, material, paint(color, look, ghost, look.isPlanar ? 0.4 : 0.6));
  group.position.z = heightOf(mechanism, number);
  label(group, body.name);
  mechanism.frames[body.frame].add(group);
}

/** A body whose points move against each other: links between all of them. */
function addDeformedBody(mechanism, body, material) {
  body.points.forEach((from, i) => body.points.slice(i + 1).forEach((to) => {
    addMoving(mechanism, body.name, new L.Mesh(rodGeometry(0.8 * mechanism.look.radius), material), [from, to], 0);
  }));
}

/** An object that reaches from one place to another. */
function addMoving(mechanism, name, object, ends, height) {
  label(object, name);
  mechanism.root.add(object);
  mechanism.moving.push({ object, ends, height });
}

/** Marks an object and its parts with the name that is shown when the pointer is over it. */
function label(object, name) {
  object.traverse((part) => { part.userData.name = name; });
}

function addJoint(mechanism, joint, ghost) {
  const { look, clip } = mechanism;
  const material = paint(look.isDark ? '#c8d0da' : '#3b4450', look, ghost);
  const name = `${joint.name} (${joint.kind})`;
  const objects = [];
  const axis = joint.axis ? vector(joint.axis).normalize() : null;
  const slides = ['prismatic', 'cylindrical', 'point_on_line'].includes(joint.kind) && axis && joint.ends.length > 1;
  const travel = slides ? travelOf(joint, axis, clip, look) : [0, 0];
  const usable = JOINTS[joint.kind] && (axis || !['revolute', 'prismatic', 'cylindrical', 'point_on_line', 'planar'].includes(joint.kind));
  const parts = (usable ? JOINTS[joint.kind] : diamond)({ axis, travel, look, material, radii: joint.radii || [] });
  parts.forEach((meshes, end) => meshes.forEach((mesh) => {
    objects.push(attach(mechanism, joint.ends[end] || joint.ends[0], mesh, jointHeight(mechanism, joint)));
  }));
  objects.forEach((object) => label(object, name));
  if (joint.kind === 'distance') {
    const rod = new L.Mesh(rodGeometry(0.65 * look.radius), material);
    addMoving(mechanism, name, rod, joint.ends, 0.5 * look.depth);
    objects.push(rod);
    joint.ends.forEach((end) => {
      const ball = addBall(new L.Group(), new L.Vector3(), 1.1 * look.radius, material);
      label(ball, name);
      objects.push(attach(mechanism, end, ball, 0.5 * look.depth));
    });
  }
  mechanism.joints.push({ material, color: material.color.clone(), objects });
}

/** Height of the middle of a planar joint's symbol. */
function jointHeight(mechanism, joint) {
  const { look } = mechanism;
  if (!look.isPlanar) return 0;
  return joint.kind === 'revolute' ? 0.5 * (look.depth - look.layer) : 0.5 * look.depth;
}

/** Puts an object at a place, with its axes. */
function attach(mechanism, place, object, height = 0) {
  const holder = new L.Group();
  holder.position.set(...place.at);
  holder.position.z += height;
  holder.quaternion.copy(rotationOf(place));
  holder.add(object);
  mechanism.frames[place.frame].add(holder);
  return holder;
}

function addForce(mechanism, force, steel, ghost) {
  const { look } = mechanism;
  const name = `${force.name} (${force.kind})`;
  const height = look.isPlanar ? 0.5 * look.depth : 0;
  if (force.kind === 'spring_damper' && force.ends.length > 1) {
    const tube = new Tube(COIL_POINTS + 3, 0.3 * look.radius, paint(look.isDark ? '#8fd6a2' : '#1f7a3d', look, ghost), 6);
    label(tube.mesh, name);
    mechanism.root.add(tube.mesh);
    mechanism.springs.push({ tube, ends: force.ends, height });
  } else if (['beam', 'bushing'].includes(force.kind) && force.ends.length > 1) {
    addMoving(mechanism, name, new L.Mesh(rodGeometry(0.5 * look.radius), steel), force.ends, height);
    if (force.kind === 'bushing') label(attach(mechanism, force.ends[0], addBall(new L.Group(), new L.Vector3(), 2.6 * look.radius, paint(STEEL, look, ghost, 0.5)), height), name);
  } else if (force.kind === 'torsion_spring') {
    label(attach(mechanism, force.ends[0], spiralMesh(look, steel), look.isPlanar ? look.depth : 0), name);
  } else if (force.kind === 'tyre') {
    addTyre(mechanism, force, name, steel, ghost);
  } else if (force.kind === 'applied_force') {
    const arrow = arrowMesh(look, paint(look.isDark ? '#ff8f8f' : '#b3202c', look, ghost));
    label(arrow, name);
    mechanism.root.add(arrow);
    mechanism.arrows.push({ arrow, place: force.ends[0], height: look.depth });
  }
}

function addTyre(mechanism, force, name, steel, ghost) {
  const { look } = mechanism;
  const rubber = paint(look.isDark ? '#59636f' : '#2d343d', look, ghost, 0.55);
  label(attach(mechanism, force.ends[0], tyreMesh(force.radii[0], look, rubber, steel)), name);
  const length = 2.6 * force.radii[0];
  const width = look.isPlanar ? 2 * look.layer : 0.8 * force.radii[0];
  const sizes = [length, width, width];
  sizes[look.up] = 0.04 * force.radii[0];
  const road = new L.Mesh(new L.BoxGeometry(...sizes), paint('#8a8f98', look, ghost, 0.6));
  label(road, `road under ${force.name}`);
  mechanism.root.add(road);
  mechanism.roads.push({ road, place: force.ends[0], thickness: sizes[look.up] });
}

/** An arrow of length 1 along y. */
function arrowMesh(look, material) {
  const arrow = new L.Group();
  const shaft = new L.Mesh(rodGeometry(0.45 * look.radius), material);
  const head = new L.Mesh(new L.ConeGeometry(1.3 * look.radius, 0.22, 18), material);
  head.position.y = 1;
  arrow.add(shaft, head);
  return arrow;
}

/** A foot at each place of the ground that carries a joint or force. */
function addGround(mechanism, steel) {
  const { look, data } = mechanism;
  const known = [];
  const bare = ['prismatic', 'cylindrical', 'point_on_line', 'equation', 'driver', 'applied_force', 'applied_torque', 'tyre', 'gear'];
  for (const link of [...data.joints, ...data.forces]) {
    link.ends.forEach((end, k) => {
      const at = vector(end.at);
      if (link.bodies[k] !== null || bare.includes(link.kind) || known.some((other) => other.distanceTo(at) < look.radius)) return;
      known.push(at);
      const foot = new L.Mesh(footGeometry(look), steel);
      foot.position.copy(at);
      label(foot, 'ground');
      mechanism.root.add(foot);
    });
  }
}

/** A pyramid, in the plane a wedge, with its tip at the origin and its base below. */
function footGeometry(look) {
  const height = 4 * look.radius;
  const geometry = look.isPlanar ? new L.CylinderGeometry(0, 3.2 * look.radius, height, 3, 1) : new L.CylinderGeometry(0.6 * look.radius, 2.8 * look.radius, height, 24);
  geometry.translate(0, -0.5 * height, 0);
  if (look.isPlanar) {
    geometry.rotateY(Math.PI);
    geometry.scale(1, 1, (0.4 * look.layer) / look.radius);
    geometry.translate(0, 0, -0.7 * look.layer);
  }
  if (look.up === 2) geometry.rotateX(0.5 * Math.PI);
  if (look.up === 0) geometry.rotateZ(-0.5 * Math.PI);
  return geometry;
}

/** Moves a mechanism to a time of a clip: of its own motion, or of a mode. */
function poseMechanism(mechanism, t, clip = mechanism.clip) {
  const rows = bracket(clip.t, t);
  const { frames, look } = mechanism;
  frames.forEach((frame, number) => {
    const { position, quaternion } = poseAt(clip, look.isPlanar, number, rows);
    frame.position.copy(position);
    frame.quaternion.copy(quaternion);
    frame.updateMatrixWorld();
  });
  mechanism.moving.forEach(({ object, ends, height }) => stretch(object, ...endsAt(mechanism, ends, height)));
  mechanism.springs.forEach(({ tube, ends, height }) => tube.follow(coilPoints(...endsAt(mechanism, ends, height), 1.9 * look.radius)));
  poseLines(mechanism, clip, rows);
  poseForces(mechanism, clip, rows);
}

/** Positions of two places, raised to the layer of what is between them. */
function endsAt(mechanism, ends, height) {
  return ends.slice(0, 2).map((end) => where(mechanism, end)).map((point) => point.setZ(point.z + height));
}

function poseLines(mechanism, clip, rows) {
  const dimension = mechanism.look.isPlanar ? 2 : 3;
  const width = rowWidth(clip, clip.lines);
  let first = 0;
  for (const { tube, count, height } of mechanism.lines) {
    const points = Array.from({ length: count }, (_, k) => {
      const value = (i) => mix(clip.lines, width, first + k * dimension + i, rows);
      return new L.Vector3(value(0), value(1), dimension === 3 ? value(2) : height);
    });
    tube.follow(points);
    first += count * dimension;
  }
}

function poseForces(mechanism, clip, rows) {
  const { look, roads, arrows } = mechanism;
  roads.forEach(({ road, place, thickness }, k) => {
    road.position.copy(where(mechanism, place));
    road.position.setComponent(look.up, mix(clip.roads, roads.length, k, rows) - 0.5 * thickness);
  });
  arrows.forEach(({ arrow, place, height }, k) => {
    const force = new L.Vector3(...[0, 1, 2].map((i) => mix(clip.arrows, 3 * arrows.length, 3 * k + i, rows)));
    const from = where(mechanism, place);
    if (look.isPlanar) from.z += height;
    const length = force.length();
    arrow.visible = length > 1e-6 * mechanism.largestForce;
    const reach = 0.16 * look.size * Math.sqrt(length / mechanism.largestForce);
    if (arrow.visible) stretch(arrow, from, from.clone().addScaledVector(force, reach / length));
  });
}

// Viridis at nine places: from none to the largest force.
const SCALE = ['#440154', '#482878', '#3e4a89', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#fde725'];

/** Colours joints by the force in them; `most` is that of the last colour. Without it they have their own colours. */
function colorJoints(mechanism, t, most) {
  const { clip } = mechanism;
  const rows = bracket(clip.t, t);
  mechanism.joints.forEach((joint, k) => {
    if (!most) {
      joint.material.color.copy(joint.color);
      return;
    }
    const part = Math.min(1, mix(clip.reactions, mechanism.joints.length, k, rows) / most) * (SCALE.length - 1);
    const low = Math.min(SCALE.length - 2, Math.floor(part));
    joint.material.color.set(SCALE[low]).lerp(new L.Color(SCALE[low + 1]), part - low);
  });
}
