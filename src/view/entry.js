// All that the page uses of its two libraries. `build.sh` bundles it into `libraries.js.gz`, where it is named `L`.
export {
  AmbientLight, BoxGeometry, Box3, BufferAttribute, BufferGeometry, CapsuleGeometry, CatmullRomCurve3, Color, ConeGeometry,
  CylinderGeometry, DirectionalLight, DoubleSide, ExtrudeGeometry, GridHelper, Group, HemisphereLight, Line, LineBasicMaterial,
  Matrix4, Mesh, MeshStandardMaterial, OctahedronGeometry, PerspectiveCamera, Quaternion, Raycaster, Scene, Shape,
  SphereGeometry, TorusGeometry, TubeGeometry, Vector2, Vector3, WebGLRenderer,
} from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
export { ConvexGeometry } from 'three/examples/jsm/geometries/ConvexGeometry.js';
export { default as uPlot } from 'uplot';
