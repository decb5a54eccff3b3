// The lights of a 3-D view, drawn by kind in their own colour: balls at their true size but never too small to see, cones of
// spots, disks with their facing, arrows of directional lights. A ring says how near a light is taken.

const kLeastPixels = 5;    // radius of a light on the screen
const kRingPixels = 10;
const kConeLength = 0.7;   // of the object's radius
const kArrowLength = 0.55;
const kFarthestShown = 8;  // radii of the object

// A ball that darkens towards its edge, so that a white one is seen on white too.
const kBallVertex = `
varying vec3 vNormal, vToEye;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vToEye = -eye.xyz;
  gl_Position = projectionMatrix * eye;
}`;
const kBallFragment = `
uniform vec3 color;
uniform float opacity;
varying vec3 vNormal, vToEye;
void main() {
  float facing = abs(dot(normalize(vNormal), normalize(vToEye)));
  vec3 shown = mix(color * 0.4, mix(color, vec3(1.0), 0.6 * smoothstep(0.7, 1.0, facing)), smoothstep(0.15, 0.6, facing));
  gl_FragColor = vec4(shown, opacity);
}`;

/** With the properties that this file sets on others. */
function ballMaterial(color) {
  const shown = color.clone().convertLinearToSRGB();
  const material = new THREE.ShaderMaterial({vertexShader: kBallVertex, fragmentShader: kBallFragment, transparent: true,
    uniforms: {color: {value: [shown.r, shown.g, shown.b]}, opacity: {value: 1}}});
  Object.defineProperty(material, 'opacity', {get: () => material.uniforms.opacity.value, set: (value) => { if (material.uniforms) material.uniforms.opacity.value = value; }});
  return material;
}

/** {node, lights, show(), fit(camera, height), places(), at(raycaster), paint(host)}; `rows`: the report's lights of the scene. */
function lightsView(view, scene, place, rows, radius) {
  const node = new THREE.Group();
  const lights = scene.lights.map((light, i) => lightShape(light, rows[light.index], place(i, 0), radius));
  for (const light of lights) node.add(light.node);
  let center = [0, 0, 0];
  const forward = new THREE.Vector3(0, 0, 1);
  return {
    node, lights,
    /** `frame` of the view; `sceneFrame` of the scene's. `target`: the object's middle. */
    show(frame, sceneFrame, rig, target) {
      center = target;
      lights.forEach((light, i) => {
        const {position, direction, radius: size} = place(i, sceneFrame);
        const byte = view.rigs[rig].lights[frame][i];
        light.size = size;
        light.near = nearShare(byte);
        light.culled = byte === kCulled;
        const at = new THREE.Vector3(...position);
        const along = new THREE.Vector3(...direction);
        if (light.kind === 'directional') at.set(...center).addScaledVector(along, -2.1 * radius);
        light.node.position.copy(at);
        if (along.lengthSq()) light.turned.quaternion.setFromUnitVectors(forward, along);
        for (const material of light.materials) material.opacity = material.userData.opacity * (light.culled ? 0.25 : light.near > 0 ? 1 : 0.8);
        light.ring.visible = light.near > 0;
        light.ring.material.opacity = 0.35 + 0.65 * light.near;
      });
    },
    /** Before drawing: sizes on the screen, and rings that face the eye. */
    fit(camera, height) {
      const pixel = 2 * Math.tan(THREE.MathUtils.degToRad(camera.fov) / 2) / height;
      for (const light of lights) {
        const meter = camera.position.distanceTo(light.node.position) * pixel;
        const size = Math.max(light.kind === 'disk' ? 0 : light.size, kLeastPixels * meter);
        light.ball.scale.setScalar(light.kind === 'disk' ? Math.max(light.size, kLeastPixels * meter) : size);
        light.ring.scale.setScalar(Math.max(size + 6 * meter, kRingPixels * meter));
        light.pixels = light.ring.scale.x / meter;
        light.ring.quaternion.copy(camera.quaternion);
      }
    },
    /** The nearer half of the lights, relative to the object's middle, no farther than it can still be seen from. */
    places(objectSize) {
      const around = lights.map((light) => light.node.position.toArray().map((x, axis) => x - center[axis])).sort((a, b) => Math.hypot(...a) - Math.hypot(...b));
      return around.slice(0, Math.ceil(around.length / 2)).filter((point) => Math.hypot(...point) < kFarthestShown * objectSize);
    },
    at(raycaster) {
      let best = null;
      for (const light of lights) {
        const [hit] = raycaster.intersectObject(light.kind === 'directional' ? light.turned : light.ball, light.kind === 'directional');
        if (hit && (!best || hit.distance < best.distance)) best = {distance: hit.distance, light};
      }
      return best;
    },
    paint(host) {
      const accent = styleColor(host, '--accent');
      const text = new THREE.Color().setRGB(...styleColor(host, '--text'), 'srgb');
      for (const light of lights) {
        light.ring.material.color.setRGB(...accent, 'srgb');
        // Towards the page's text, so that pale lines are seen on a pale page.
        light.node.traverse((part) => { if (part.isLineSegments) part.material.color.copy(light.color).lerp(text, 0.45); });
      }
    },
  };
}

/** The hue of a light as bright as a screen shows it. */
function lightColor([r, g, b]) {
  const most = Math.max(r, g, b, 1e-30);
  return new THREE.Color().setRGB(...[r, g, b].map((x) => Math.max(0, x) / most));
}

function lightShape(light, row, {radius: size}, objectRadius) {
  const color = lightColor(light.color);
  const materials = [];
  const material = (opacity, more) => {
    const made = new THREE.MeshBasicMaterial({color, transparent: true, opacity, ...more});
    made.userData = {opacity};
    materials.push(made);
    return made;
  };
  const node = new THREE.Group();
  const turned = new THREE.Group();  // +z is the way the light travels
  const round = ballMaterial(color);
  round.userData = {opacity: 1};
  materials.push(round);
  const ball = new THREE.Mesh(kindGeometry(row.type), row.type === 'disk' ? material(0.85, {side: THREE.DoubleSide}) : round);
  if (row.type === 'directional') {
    const length = kArrowLength * objectRadius;
    const shaft = new THREE.Mesh(new THREE.CylinderGeometry(0.014 * objectRadius, 0.014 * objectRadius, length, 12), round);
    const head = new THREE.Mesh(new THREE.ConeGeometry(0.05 * objectRadius, 0.16 * objectRadius, 24), round);
    for (const part of [shaft, head]) part.rotation.x = Math.PI / 2;
    shaft.position.z = length / 2;
    head.position.z = length;
    turned.add(shaft, head);
  } else if (row.type === 'disk') {
    turned.add(ball);
    ball.add(lineOf(Array.from({length: 48}, (_, i) => [i, i + 1].map((k) => [Math.cos(k * Math.PI / 24), Math.sin(k * Math.PI / 24), 0])).flat(), color));
    const length = Math.max(size, 0.15 * objectRadius);
    turned.add(lineOf([[0, 0, 0], [0, 0, length]], color), ...(light.two_sided ? [lineOf([[0, 0, 0], [0, 0, -length]], color)] : []));
  } else {
    node.add(ball);
    if (light.cone) turned.add(...coneOf(light.cone[1], kConeLength * objectRadius, color, material));
  }
  const ring = new THREE.Mesh(new THREE.RingGeometry(0.86, 1, 48), new THREE.MeshBasicMaterial({transparent: true, depthTest: false, side: THREE.DoubleSide}));
  ring.renderOrder = 2;
  node.add(turned, ring);
  return {node, turned, ball, ring, materials, color, kind: row.type, row, index: light.index, size, near: 0, culled: false};
}

const kindGeometry = (type) => (type === 'disk' ? new THREE.CircleGeometry(1, 48) : new THREE.SphereGeometry(1, 24, 16));

function lineOf(points, color) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points.flat()), 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color, transparent: true, opacity: 0.7}));
}

/** A cone that opens by `angle` from the axis, at most a hemisphere, as a shade and four lines. */
function coneOf(angle, length, color, material) {
  const open = Math.min(angle, 0.48 * Math.PI);
  const [width, height] = [length * Math.sin(open), length * Math.cos(open)];
  const shade = new THREE.Mesh(new THREE.ConeGeometry(width, height, 40, 1, true), material(0.1, {side: THREE.DoubleSide, depthWrite: false}));
  shade.rotation.x = -Math.PI / 2;
  shade.position.z = height / 2;
  const edges = [];
  const rim = (i) => [width * Math.cos(i * Math.PI / 20), width * Math.sin(i * Math.PI / 20), height];
  for (let i = 0; i < 40; ++i) edges.push(rim(i), rim(i + 1));
  for (let i = 0; i < 40; i += 10) edges.push([0, 0, 0], rim(i));
  const lines = lineOf(edges, color);
  lines.material.opacity = 0.45;
  return [shade, lines];
}
