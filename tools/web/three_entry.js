// What the 3-D view of Rigel's report uses of three.js. Only this goes into bundle/three.js.
export {
  BufferAttribute, BufferGeometry, CircleGeometry, Color, ConeGeometry, CylinderGeometry, DoubleSide, DynamicDrawUsage, EdgesGeometry, Group,
  InstancedBufferAttribute, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, PerspectiveCamera, Points, Quaternion,
  Raycaster, RingGeometry, Scene, ShaderMaterial, SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from 'three';
export {OrbitControls} from 'three/addons/controls/OrbitControls.js';
