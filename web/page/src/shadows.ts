import { Camera, Color, DoubleSide, HalfFloatType, Mesh, NearestFilter, PerspectiveCamera, RedFormat, ShaderMaterial, Vector3, WebGLRenderTarget, type Material, type Scene, type WebGLRenderer } from 'three';

/** Texels along the edge of a face: 1 cm at 2.5 m. */
export const faceSize = 512;

// Along +x, -x, +y, -y, +z, -z, each with what is up in its picture; shaders/`face` in lamps.ts has the same order.
const faces: [Vector3, Vector3][] = [
  [new Vector3(1, 0, 0), new Vector3(0, 1, 0)], [new Vector3(-1, 0, 0), new Vector3(0, 1, 0)],
  [new Vector3(0, 1, 0), new Vector3(0, 0, 1)], [new Vector3(0, -1, 0), new Vector3(0, 0, 1)],
  [new Vector3(0, 0, 1), new Vector3(0, 1, 0)], [new Vector3(0, 0, -1), new Vector3(0, 1, 0)],
];

/** Of each lamp a row of six pictures of what is around it: 1 / distance [1/m], 0 where there is nothing. */
export class Shadows {
  readonly target: WebGLRenderTarget;
  private readonly material: ShaderMaterial;
  private readonly camera = new PerspectiveCamera(90, 1, 0.005, 1000);

  constructor(lamps: number) {
    this.target = new WebGLRenderTarget(6 * faceSize, lamps * faceSize, {
      format: RedFormat, type: HalfFloatType, minFilter: NearestFilter, magFilter: NearestFilter, generateMipmaps: false });
    this.target.scissorTest = true;
    this.material = new ShaderMaterial({
      side: DoubleSide,
      uniforms: { lamp: { value: new Vector3() } },
      vertexShader: 'varying vec3 at;\nvoid main() { vec4 world = modelMatrix * vec4(position, 1.0); at = world.xyz; gl_Position = projectionMatrix * viewMatrix * world; }',
      fragmentShader: 'uniform vec3 lamp;\nvarying vec3 at;\nvoid main() { gl_FragColor = vec4(1.0 / distance(at, lamp), 0.0, 0.0, 1.0); }',
    });
  }

  /** Looks around from a lamp's place; what is clear, and lamps themselves, cast no shadow. */
  look(renderer: WebGLRenderer, scene: Scene, lamp: number, at: Vector3, balls: Iterable<Mesh>): void {
    const hidden: Mesh[] = [], { background } = scene, clear = renderer.getClearColor(new Color()), alpha = renderer.getClearAlpha();
    const hide = (mesh: Mesh) => { if (mesh.visible) hidden.push(mesh), mesh.visible = false; };
    for (const ball of balls) hide(ball);
    scene.traverse(object => {
      if (object instanceof Mesh && (object.material as Material & { transmission?: number }).transmission! > 0) hide(object);
    });
    scene.background = null;
    scene.overrideMaterial = this.material;
    renderer.setClearColor(0, 0);
    (this.material.uniforms.lamp!.value as Vector3).copy(at);
    this.camera.position.copy(at);
    faces.forEach(([ahead, up], i) => {
      this.camera.up.copy(up);
      this.camera.lookAt(at.clone().add(ahead));
      this.target.viewport.set(i * faceSize, lamp * faceSize, faceSize, faceSize);
      this.target.scissor.copy(this.target.viewport);
      renderer.setRenderTarget(this.target);
      renderer.clear();
      renderer.render(scene, this.camera as Camera);
    });
    renderer.setRenderTarget(null);
    renderer.setClearColor(clear, alpha);
    scene.overrideMaterial = null;
    scene.background = background;
    for (const mesh of hidden) mesh.visible = true;
  }
}
