import { Box3, CubeCamera, HalfFloatType, LinearFilter, LinearMipmapLinearFilter, MeshStandardMaterial, Vector3, WebGLCubeRenderTarget, type IUniform, type Material, type Mesh, type Scene, type Texture, type WebGLProgramParametersWithUniforms, type WebGLRenderer } from 'three';

/** Texels along the edge of a face. */
const faceSize = 256;
/** What mirrors less than that is given the mean of its hemisphere. */
const leastMetal = 0.5, mostRough = 0.5;
/** Each is six pictures of the scene after every change of the light. */
const mostMirrors = 4;
/** So near to one another bodies are one [m]. */
const gap = 0.02;

/** The uniforms of a mirror, by which a material that is lit takes it. */
export interface Mirror { mirror: IUniform<Texture>; mirrorAt: IUniform<Vector3> }

/**
 * GLSL: `vec3 mirrored(vec3 x, vec3 way, float alpha)`, radiance from that way. The picture is taken at another place than x: what a
 * way meets is found by the distances in it (Szirmay-Kalos et al., Approximate ray-tracing on the GPU with distance impostors, 2005).
 */
export const mirrorShader = `
uniform highp samplerCube mirror;
uniform vec3 mirrorAt;

vec3 mirrored(vec3 x, vec3 way, float alpha) {
  vec3 from = x - mirrorAt, to = way;
  float t = 0.0;
  for (int i = 0; i < 6; ++i) {
    float seen = 1.0 / max(textureLod(mirror, to, 0.0).a, 1e-3);
    t = max(0.0, t + (i == 0 ? seen : seen - length(to)));
    to = from + t * way;
  }
  float wide = 2.0 * alpha * t / max(length(to), 1e-3);  // the lobe's angle as the picture sees it
  return textureLod(mirror, to, max(0.0, log2(wide * ${faceSize / (Math.PI / 2)}))).rgb;
}
`;

/** Where such a picture is taken (`taking` is 1), 1 / distance is what a surface's shader has for alpha. */
export function tellDistance(shader: WebGLProgramParametersWithUniforms, taking: IUniform<number>): void {
  shader.uniforms.taking = taking;
  shader.fragmentShader = `uniform float taking;\n${shader.fragmentShader.replace('#include <opaque_fragment>', `#include <opaque_fragment>
if (taking > 0.0) gl_FragColor.a = gl_FragCoord.w / length(vec3(gl_FragCoord.xy * ${2 / faceSize} - 1.0, 1.0));`)}`;
}

/** Bodies of smooth metal, and what is seen around each: radiance, and 1 / distance [1/m]. */
export class Mirrors {
  /** 1 while such a picture is taken. */
  readonly taking: IUniform<number> = { value: 0 };
  /** Whether the light changed since. */
  stale = true;
  private readonly bodies: { meshes: Mesh[]; camera: CubeCamera; target: WebGLCubeRenderTarget; uniforms: Mirror }[];

  constructor(meshes: Mesh[]) {
    const bodies: { box: Box3; meshes: Mesh[] }[] = [];
    for (const mesh of meshes.filter(({ material }) => isMirror(material))) {
      const box = new Box3().setFromObject(mesh), wide = box.clone().expandByScalar(gap), all = [mesh];
      for (let i = bodies.length; i-- > 0;) {
        if (!bodies[i]!.box.intersectsBox(wide)) continue;
        const [other] = bodies.splice(i, 1);
        box.union(other!.box), all.push(...other!.meshes);
      }
      bodies.push({ box, meshes: all });
    }
    const size = ({ box }: { box: Box3 }) => box.getSize(new Vector3()).length();
    this.bodies = bodies.sort((a, b) => size(b) - size(a)).slice(0, mostMirrors).map(body => {
      const target = new WebGLCubeRenderTarget(faceSize, { type: HalfFloatType, generateMipmaps: true, minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter });
      const camera = new CubeCamera(0.01, 1000, target), at = body.box.getCenter(camera.position);
      return { meshes: body.meshes, camera, target, uniforms: { mirror: { value: target.texture }, mirrorAt: { value: at } } };
    });
  }

  of(mesh: Mesh): Mirror | undefined { return this.bodies.find(({ meshes }) => meshes.includes(mesh))?.uniforms; }

  look(renderer: WebGLRenderer, scene: Scene): void {
    if (!this.stale) return;
    this.stale = false;
    this.taking.value = 1;
    for (const { meshes, camera } of this.bodies) {
      const shown = meshes.filter(mesh => mesh.visible);
      for (const mesh of shown) mesh.visible = false;
      camera.update(renderer, scene);
      for (const mesh of shown) mesh.visible = true;
    }
    this.taking.value = 0;
  }
}

function isMirror(material: Material | Material[]): boolean {
  return material instanceof MeshStandardMaterial && material.metalness >= leastMetal && material.roughness <= mostRough;
}
