// What the 3-D view of Rigel's report uses of three.js. Only this goes into bundle/three.js.
export {
  BufferAttribute, BufferGeometry, CanvasTexture, CircleGeometry, Color, ConeGeometry, CylinderGeometry, DoubleSide, Group, LineBasicMaterial, LineSegments,
  MathUtils, Mesh, MeshBasicMaterial, PerspectiveCamera, Points, Raycaster, RingGeometry, Scene, ShaderMaterial, SphereGeometry, Vector2, Vector3,
  WebGLRenderer,
} from 'three';
export {OrbitControls} from 'three/addons/controls/OrbitControls.js';
