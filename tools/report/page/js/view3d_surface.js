// The object of a 3-D view: its surface in false colours or lit, the rig's box and the points at which the rig samples light.

const kSurfaces = [
  {value: 'absolute', label: 'Error', title: 'Size of the error: RMS over the colour channels'},
  {value: 'signed', label: 'Signed', title: 'Mean over the colour channels: blue is too dark, red too bright'},
  {value: 'rig', label: 'Lit by rig', title: 'Irradiance by the rig and its near lights, on white'},
  {value: 'truth', label: 'Lit by truth', title: 'Exact irradiance, on white'},
];
const kSignedColors = ['#3b6fd6', '#7ea3e4', '#bccdee', '#eeeeec', '#f3c5a9', '#e58d60', '#cf4426'];
const isError = (surface) => surface === 'absolute' || surface === 'signed';
const kDisplayGamma = 2.2;
const kDotPixels = 8;

const kSurfaceVertex = `
attribute vec3 light;
varying vec3 vLight, vNormal, vToEye;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vLight = light;
  vNormal = normalMatrix * normal;
  vToEye = -eye.xyz;
  gl_Position = projectionMatrix * eye;
}`;
// Errors: colour by the scale, softly shaded as from the eye, so that shape is seen and colour still read. Light: a curve that
// leaves the mean where it is and lets bright places fade into white.
const kSurfaceFragment = `
uniform sampler2D ramp;
uniform int kind;
uniform float scale;
varying vec3 vLight, vNormal, vToEye;
void main() {
  if (kind == 2) {
    gl_FragColor = vec4(pow(1.0 - exp(-max(vLight, 0.0) * scale), vec3(1.0 / ${kDisplayGamma.toFixed(1)})), 1.0);
    return;
  }
  float share = kind == 0 ? length(vLight) * 0.57735027 * scale : 0.5 + 0.5 * scale * (vLight.r + vLight.g + vLight.b) / 3.0;
  vec3 color = texture2D(ramp, vec2(clamp(share, 0.001, 0.999), 0.5)).rgb;
  float facing = abs(dot(normalize(vNormal), normalize(vToEye)));
  gl_FragColor = vec4(color * (0.55 + 0.45 * facing), 1.0);
}`;

const kDotVertex = `
uniform float size;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = size;
}`;
const kDotFragment = `
uniform vec3 fill, rim;
void main() {
  float r = 2.0 * length(gl_PointCoord - 0.5);
  if (r > 1.0) discard;
  gl_FragColor = vec4(mix(fill, rim, smoothstep(0.55, 0.7, r)), 1.0);
}`;

/** Colours as a row of texels. */
function rampTexture(colors) {
  const canvas = element('canvas', {width: 256, height: 1});
  const context = canvas.getContext('2d');
  const gradient = context.createLinearGradient(0, 0, 256, 0);
  colors.forEach((color, i) => gradient.addColorStop(i / (colors.length - 1), color));
  context.fillStyle = gradient;
  context.fillRect(0, 0, 256, 1);
  return new THREE.CanvasTexture(canvas);
}

/** What of the page's style a canvas needs, as three numbers from 0 to 1. */
function styleColor(node, name) {
  const probe = element('span');
  probe.style.color = `var(${name})`;
  node.append(probe);
  const context = element('canvas', {width: 1, height: 1}).getContext('2d');
  context.fillStyle = getComputedStyle(probe).color;
  context.fillRect(0, 0, 1, 1);
  probe.remove();
  return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3).map((byte) => byte / 255);
}

/** {node, show(frame, rig, surface, scale), at(hit), paint(host)}: `node` is to be added to the scene. */
function surfaceView(view, meanIrradiance) {
  const node = new THREE.Group();
  node.matrixAutoUpdate = false;
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(view.triangles, 1));
  const ramps = {absolute: rampTexture(embedded.colors), signed: rampTexture(kSignedColors)};
  const material = new THREE.ShaderMaterial({vertexShader: kSurfaceVertex, fragmentShader: kSurfaceFragment, side: THREE.DoubleSide,
    uniforms: {ramp: {value: ramps.absolute}, kind: {value: 0}, scale: {value: 1}}});
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  const box = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({transparent: true, opacity: 0.55}));
  box.frustumCulled = false;
  const dots = new THREE.Points(new THREE.BufferGeometry(), new THREE.ShaderMaterial({vertexShader: kDotVertex, fragmentShader: kDotFragment,
    depthTest: false, uniforms: {size: {value: 7}, fill: {value: [1, 1, 1]}, rim: {value: [0, 0, 0]}}}));
  dots.frustumCulled = false;
  dots.renderOrder = 3;
  node.add(mesh, box, dots);
  const lit = new Float32Array(3 * view.positions[0].length / 3);
  let shown = {};

  /** Irradiance by the rig. */
  function byRig(frame, rig) {
    view.truth[frame].forEach((truth, i) => { lit[i] = truth + meanIrradiance * view.rigs[rig].error[frame][i]; });
    return lit;
  }

  return {
    node, box, dots,
    show(frame, rig, surface, scale) {
      if (shown.positions !== view.positions[frame]) {
        geometry.setAttribute('position', new THREE.BufferAttribute(view.positions[frame], 3));
        geometry.computeVertexNormals();
        geometry.computeBoundingSphere();
      }
      shown = {positions: view.positions[frame], frame, rig};
      const light = surface === 'truth' ? view.truth[frame] : surface === 'rig' ? byRig(frame, rig) : view.rigs[rig].error[frame];
      geometry.setAttribute('light', new THREE.BufferAttribute(light, 3));
      material.uniforms.kind.value = {absolute: 0, signed: 1, rig: 2, truth: 2}[surface];
      material.uniforms.ramp.value = ramps[surface] ?? ramps.absolute;
      material.uniforms.scale.value = isError(surface) ? 1 / scale : 0.8 / (meanIrradiance || 1);
      box.geometry.setAttribute('position', new THREE.BufferAttribute(boxEdges(view.rigs[rig].boxes[frame]), 3));
      dots.geometry.setAttribute('position', new THREE.BufferAttribute(view.rigs[rig].samples[frame], 3));
      const [xx, xy, xz, yx, yy, yz, zx, zy, zz, ox, oy, oz] = view.poses[frame];
      node.matrix.set(xx, yx, zx, ox, xy, yy, zy, oy, xz, yz, zz, oz, 0, 0, 0, 1);
      node.updateMatrixWorld(true);
    },
    /** What is under a ray: {distance, absolute, signed, truth} or null. */
    at(raycaster) {
      const [hit] = raycaster.intersectObject(mesh);
      if (!hit) return null;
      const mix = (values) => [0, 1, 2].map((channel) => ['a', 'b', 'c'].reduce((sum, corner) =>
        sum + hit.barycoord.getComponent('abc'.indexOf(corner)) * values[3 * hit.face[corner] + channel], 0));
      const error = mix(view.rigs[shown.rig].error[shown.frame]);
      const mean = (values) => (values[0] + values[1] + values[2]) / 3;
      return {distance: hit.distance, absolute: Math.sqrt(mean(error.map((e) => e * e))), signed: mean(error), truth: mean(mix(view.truth[shown.frame]))};
    },
    /** Before drawing: dots are smaller where the object is. */
    fit(camera, height, radius) {
      const away = camera.position.distanceTo(new THREE.Vector3().setFromMatrixPosition(node.matrix));
      const pixels = 0.02 * radius * height / (away * Math.tan(THREE.MathUtils.degToRad(camera.fov) / 2));
      dots.material.uniforms.size.value = Math.min(kDotPixels, Math.max(0.4 * kDotPixels, pixels)) * Math.min(2, devicePixelRatio);
    },
    paint(host) {
      box.material.color.setRGB(...styleColor(host, '--text'), 'srgb');
      dots.material.uniforms.fill.value = styleColor(host, '--accent');
      dots.material.uniforms.rim.value = styleColor(host, '--card');
    },
  };
}

/** The twelve edges of [lo, hi] as pairs of points. */
function boxEdges([x0, y0, z0, x1, y1, z1]) {
  const corner = (i) => [i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0];
  const points = [];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) points.push(...corner(i), ...corner(i | bit));
  }
  return new Float32Array(points);
}

/** The least of 1, 2, 5, 10, 20, ... per cent that no more than a fiftieth of the vertices exceed in any frame. */
function errorScale(rig) {
  const sizes = rig.error.flatMap((frame) => {
    const values = [];
    for (let i = 0; i < frame.length; i += 3) values.push(Math.hypot(frame[i], frame[i + 1], frame[i + 2]) / Math.sqrt(3));
    return values;
  }).sort((a, b) => a - b);
  return roundScale(sizes[Math.floor(0.98 * (sizes.length - 1))] ?? 0, 0);
}

/** The 1-2-5 step at or above `value`, and `steps` further. */
function roundScale(value, steps) {
  const factors = [1, 2, 5];
  const wanted = Math.max(value, 0.001) * (1 - 1e-9);
  let index = 3 * Math.floor(Math.log10(wanted));
  const at = (i) => factors[((i % 3) + 3) % 3] * 10 ** Math.floor(i / 3);
  while (at(index) < wanted) ++index;
  return at(index + steps);
}
