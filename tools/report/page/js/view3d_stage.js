// A 3-D view's canvas: camera, orbit by mouse, finger and keys, a floor, and drawing when something has changed.

const kFieldOfView = 32;
const kYaw = 0.66;    // as the report's pictures look
const kPitch = 0.31;
const kFill = 0.86;   // of the canvas, by what is to be seen
const kOrbitStep = Math.PI / 18;
const kDollyStep = 1.15;

const kFloorVertex = `
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;
const kFloorFragment = `
uniform vec3 color, middle;
uniform float step, reach;
varying vec3 vWorld;
float lines(float size) {
  vec2 place = vWorld.xz / size;
  vec2 away = abs(fract(place - 0.5) - 0.5) / fwidth(place);
  return 1.0 - min(min(away.x, away.y), 1.0);
}
void main() {
  float fade = 1.0 - smoothstep(0.15, 1.0, distance(vWorld.xz, middle.xz) / reach);
  float strength = max(0.16 * lines(step), 0.3 * lines(5.0 * step));
  gl_FragColor = vec4(color, strength * fade);
}`;

/** Does the browser draw WebGL 2 at all? */
function webglContext(canvas) {
  return canvas.getContext('webgl2', {antialias: true, alpha: true, powerPreference: 'low-power'});
}

/**
 * `canvas` with a context; `radius` of the object [m]. {scene, camera, follow(middle, bottom), redraw(), reset(corners), orbit(right, up),
 * zoom(factor), paint(host), dispose()}; `before(camera, height)` is called ahead of each drawing.
 */
function makeStage(canvas, context, radius, before) {
  const renderer = new THREE.WebGLRenderer({canvas, context, antialias: true, alpha: true});
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.01 * radius, 400 * radius);
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.minDistance = 0.3 * radius;
  controls.maxDistance = 60 * radius;
  controls.maxPolarAngle = 0.98 * Math.PI;
  controls.zoomToCursor = false;
  const floor = floorOf(radius);
  scene.add(floor);
  canvas.style.touchAction = 'pan-y';  // a finger that moves up or down still scrolls the page
  // The wheel belongs to the page until the view has been clicked.
  controls.enableZoom = false;
  const wheel = (event) => { controls.enableZoom = event.type === 'focus'; };
  canvas.addEventListener('focus', wheel);
  canvas.addEventListener('blur', wheel);

  let asked = 0;
  function draw() {
    asked = 0;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width || !height) return;
    const ratio = Math.min(2, devicePixelRatio);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
    }
    before(camera, height);
    renderer.render(scene, camera);
  }
  const redraw = () => { asked ||= requestAnimationFrame(draw); };
  controls.addEventListener('change', redraw);
  const sizes = new ResizeObserver(redraw);
  sizes.observe(canvas);

  /** As near as shows the box of `corners`, relative to the middle, whole. */
  function reset(corners) {
    const back = new THREE.Vector3(Math.cos(kPitch) * Math.sin(kYaw), Math.sin(kPitch), Math.cos(kPitch) * Math.cos(kYaw));
    const right = new THREE.Vector3(Math.cos(kYaw), 0, -Math.sin(kYaw));
    const up = back.clone().cross(right);
    const high = kFill * Math.tan(THREE.MathUtils.degToRad(kFieldOfView / 2));
    const wide = high * (canvas.clientWidth || 1) / (canvas.clientHeight || 1);
    const away = corners.map((corner) => {
      const point = new THREE.Vector3(...corner);
      return point.dot(back) + Math.max(Math.abs(point.dot(right)) / wide, Math.abs(point.dot(up)) / high);
    });
    camera.position.copy(controls.target).addScaledVector(back, Math.min(controls.maxDistance, Math.max(controls.minDistance, ...away)));
    controls.update();
    redraw();
  }
  function orbit(right, up) {
    const arm = camera.position.clone().sub(controls.target);
    const flat = Math.hypot(arm.x, arm.z);
    const [yaw, pitch] = [Math.atan2(arm.x, arm.z) + right, Math.atan2(arm.y, flat) + up];
    const bounded = Math.max(-0.48 * Math.PI, Math.min(0.48 * Math.PI, pitch));
    const length = arm.length();
    camera.position.set(Math.cos(bounded) * Math.sin(yaw), Math.sin(bounded), Math.cos(bounded) * Math.cos(yaw)).multiplyScalar(length).add(controls.target);
    controls.update();
    redraw();
  }
  return {
    scene, camera, redraw, reset, orbit,
    zoom(factor) {
      const arm = camera.position.clone().sub(controls.target);
      const length = Math.min(controls.maxDistance, Math.max(controls.minDistance, arm.length() * factor));
      camera.position.copy(controls.target).addScaledVector(arm.normalize(), length);
      controls.update();
      redraw();
    },
    /** The camera goes along with the object. */
    follow(middle, bottom) {
      const moved = new THREE.Vector3(...middle).sub(controls.target);
      controls.target.add(moved);
      camera.position.add(moved);
      floor.position.set(middle[0], bottom, middle[2]);
      floor.material.uniforms.middle.value = new THREE.Vector3(...middle);
      controls.update();
    },
    paint(host) {
      floor.material.uniforms.color.value = styleColor(host, '--text');
      redraw();
    },
    dispose() {
      cancelAnimationFrame(asked);
      sizes.disconnect();
      controls.dispose();
      renderer.dispose();
      renderer.forceContextLoss();
    },
  };
}

function floorOf(radius) {
  const reach = 10 * radius;
  const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50].find((size) => size >= 0.3 * radius) ?? 100;
  const floor = new THREE.Mesh(new THREE.CircleGeometry(reach, 48), new THREE.ShaderMaterial({vertexShader: kFloorVertex, fragmentShader: kFloorFragment,
    transparent: true, depthWrite: false, side: THREE.DoubleSide,
    uniforms: {color: {value: [0, 0, 0]}, middle: {value: new THREE.Vector3()}, step: {value: step}, reach: {value: reach}}}));
  const geometry = floor.geometry;
  geometry.rotateX(-Math.PI / 2);
  floor.userData = {step};
  return floor;
}
