// A problem in space, drawn by three.js; only when something changes.
import {
  AmbientLight, Color, CylinderGeometry, DirectionalLight, InstancedMesh, Matrix4, MeshLambertMaterial,
  PerspectiveCamera, Quaternion, Raycaster, Scene, SphereGeometry, TorusGeometry, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { colour } from './palette.js';

const ANGLE_DEG = 32;
const TURN = Math.PI / 24; // of one key press
const UP = new Vector3(0, 1, 0);

function instances(geometry, material, count) {
  const mesh = new InstancedMesh(geometry, material, Math.max(1, count));
  mesh.count = count;
  return mesh;
}

export class Scene3d {
  /** Throws where the browser has no WebGL. */
  constructor(host, width, height) {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    host.append(this.renderer.domElement);
    this.host = host;
    this.scene = new Scene();
    this.scene.add(new AmbientLight(0xffffff, 1.6));
    const lamp = new DirectionalLight(0xffffff, 1.8);
    this.camera = new PerspectiveCamera(ANGLE_DEG, 1, 0.01, 100);
    lamp.position.set(0.4, 0.8, 1);
    this.camera.add(lamp);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.render());
    this.ray = new Raycaster();
    this.resize(width, height);
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.renderer.domElement.style.height = `${height}px`;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  setShape(shape) {
    for (const mesh of [this.bodies, this.contacts, this.chains, this.rings]) {
      if (!mesh) continue;
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
      mesh.dispose();
    }
    this.shape = shape;
    this.#addBodies();
    this.contacts = instances(new SphereGeometry(1, 14, 10), new MeshLambertMaterial(), shape.count);
    this.chains = instances(new CylinderGeometry(1, 1, 1, 8, 1, true), new MeshLambertMaterial(), shape.count);
    this.#addRings();
    const matrix = new Matrix4();
    shape.contacts.forEach((p, i) => {
      matrix.makeScale(shape.dot, shape.dot, shape.dot).setPosition(...p);
      this.contacts.setMatrixAt(i, matrix);
    });
    this.scene.add(this.contacts, this.chains);
    this.#look();
  }

  #addBodies() {
    const { touched, dot } = this.shape;
    const material = new MeshLambertMaterial({ color: new Color(colour('ink-soft')), transparent: true, opacity: 0.16, depthWrite: false });
    this.bodies = instances(new SphereGeometry(1, 20, 14), material, touched.length);
    const matrix = new Matrix4();
    touched.forEach(({ centre, radius }, i) => {
      const size = radius > 0 ? radius : dot;
      this.bodies.setMatrixAt(i, matrix.makeScale(size, size, size).setPosition(...centre));
    });
    this.bodies.renderOrder = 1;
    this.scene.add(this.bodies);
  }

  #addRings() {
    const { shape } = this;
    const cohesive = shape.contacts.map((_, i) => i).filter((i) => shape.view.cohesive[i]);
    this.rings = instances(new TorusGeometry(1.7, 0.28, 6, 20), new MeshLambertMaterial({ color: new Color(colour('s3')) }), cohesive.length);
    const matrix = new Matrix4();
    const turn = new Quaternion();
    cohesive.forEach((i, k) => {
      const normal = shape.normals ? new Vector3(...shape.normals[i]) : new Vector3(...shape.from).normalize();
      turn.setFromUnitVectors(new Vector3(0, 0, 1), normal);
      matrix.compose(new Vector3(...shape.contacts[i]), turn, new Vector3(shape.dot, shape.dot, shape.dot));
      this.rings.setMatrixAt(k, matrix);
    });
    this.scene.add(this.rings);
  }

  #look() {
    const { box, from, up } = this.shape;
    const distance = (0.52 * box.diagonal) / Math.sin((ANGLE_DEG * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    const centre = new Vector3(...box.centre);
    this.camera.up.set(...up);
    this.camera.position.copy(centre).addScaledVector(new Vector3(...from).normalize(), distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    // OrbitControls reads the camera's up once, when it is made.
    this.controls.dispose();
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.copy(centre);
    this.controls.addEventListener('change', () => this.render());
    this.controls.update();
  }

  /** `colours`, one a contact; `forces`, of the chains; `shown`: {bodies, contacts, chains, cohesive}. */
  paint(colours, forces, shown) {
    const paint = new Color();
    colours.forEach((text, i) => {
      paint.set(text);
      this.contacts.setColorAt(i, paint);
      this.chains.setColorAt(i, paint);
    });
    this.contacts.instanceColor.needsUpdate = true;
    this.chains.instanceColor.needsUpdate = true;
    this.#layChains(forces);
    this.bodies.visible = shown.bodies;
    this.contacts.visible = shown.contacts;
    this.chains.visible = shown.chains;
    this.rings.visible = shown.cohesive;
    this.bodies.material.color.set(colour('ink-soft'));
    this.rings.material.color.set(colour('s3'));
    this.render();
  }

  #layChains(forces) {
    const { shape } = this;
    const largest = Math.max(...forces) || 1;
    const matrix = new Matrix4();
    const turn = new Quaternion();
    forces.forEach((force, i) => {
      const ends = shape.chain(i);
      const thickness = shape.thickest * Math.sqrt(Math.max(0, force) / largest);
      if (!ends || thickness < 0.02 * shape.thickest) {
        this.chains.setMatrixAt(i, matrix.makeScale(0, 0, 0));
        return;
      }
      const [a, b] = ends.map((p) => new Vector3(...p));
      const along = b.clone().sub(a);
      turn.setFromUnitVectors(UP, along.clone().normalize());
      matrix.compose(a.add(b).multiplyScalar(0.5), turn, new Vector3(thickness, along.length(), thickness));
      this.chains.setMatrixAt(i, matrix);
    });
    this.chains.instanceMatrix.needsUpdate = true;
  }

  /** The contact under a place of the canvas, from 0 to 1 each way; -1: none. */
  contactAt(x, y) {
    if (!this.contacts.visible) return -1;
    this.ray.setFromCamera(new Vector2(2 * x - 1, 1 - 2 * y), this.camera);
    this.contacts.computeBoundingSphere();
    return this.ray.intersectObject(this.contacts)[0]?.instanceId ?? -1;
  }

  /** Where a point is on the canvas: [x, y, depth], x and y from 0 to 1. */
  project(p) {
    const v = new Vector3(...p).project(this.camera);
    return [(v.x + 1) / 2, (1 - v.y) / 2, v.z];
  }

  turn(across, upwards) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, -across * TURN);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const lifted = offset.clone().applyAxisAngle(side, -upwards * TURN);
    if (Math.abs(lifted.clone().normalize().dot(this.camera.up)) < 0.98) offset.copy(lifted);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }

  zoom(factor) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(offset, factor);
    this.controls.update();
  }

  render() {
    if (!this.shape) return;
    this.renderer.render(this.scene, this.camera);
    this.host.dataset.camera = this.camera.position.toArray().map((v) => v.toPrecision(5)).join(' ');
  }
}
