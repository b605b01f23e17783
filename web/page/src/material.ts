import { type BufferGeometry, type MeshStandardMaterial } from 'three';
import { lampShader } from './lamp_shader';
import type { Light } from './light';
import { mirrorShader, tellDistance, type Mirror, type Mirrors } from './mirrors';

// Irradiance E goes in as light from an environment that is E/π everywhere: the diffuse layer leaves ρ E/π of what the
// specular lobe lets through, and the lobe mirrors the mean of its hemisphere. Both are what the tool's BSDF does there.
const addE = 'iblIrradiance += E;';
const mirrorMean = 'radiance += E * RECIPROCAL_PI;';
// Smooth metal shows what is around it; where it is itself in such a picture, the mean.
const mirrorRoom = `
  if (taking > 0.0) ${mirrorMean}
  else radiance += mirrored(vPlace, inverseTransformDirection(reflect(-geometryViewDir, geometryNormal), viewMatrix), material.roughness * material.roughness);
`;
const ofAtlas = `
  vec3 E = vec3(0.0);
  for (int i = 0; i < LAYERS; ++i)
    if (layers[i].rgb != vec3(0.0)) E += layers[i].rgb * texture(atlas, vec3(vAtlas, layers[i].a)).rgb;
`;

// Where a lamp is known, the lobe shows it at its place; a ball widens the lobe by half the angle that it takes. A mirror shows balls anyway.
const ofDragged = (lamps: number, mirrors: boolean) => `
  E += texture(moved, vMovedAt).rgb;
  vec3 front = normalize(vFront);
  for (int i = 0; i < ${lamps}; ++i) {
    vec3 e = ofLamp(i, vPlace, front), toLamp = lampAt[i].xyz - vPlace;
    if (e == vec3(0.0)) continue;
    iblIrradiance += e;${mirrors ? '\n    if (lampRadius(i) > 0.0) continue;' : ''}
    PhysicalMaterial seen = material;
    seen.roughness = sqrt(min(1.0, material.roughness * material.roughness + 0.5 * lampRadius(i) / length(toLamp)));
    reflectedLight.directSpecular += e * BRDF_GGX(normalize(mat3(viewMatrix) * toLamp), geometryViewDir, geometryNormal, seen);
  }
`;

/** The material lit by the atlas; in the dark where a surface has no place in it. `mirror`: of its body, if it mirrors. */
export function lit(material: MeshStandardMaterial, geometry: BufferGeometry, light: Light, mirrors: Mirrors, mirror: Mirror | undefined): MeshStandardMaterial {
  const out = material.clone();
  if (!geometry.hasAttribute('uv1')) {
    out.onBeforeCompile = shader => tellDistance(shader, mirrors.taking);
    return out;
  }
  const { lamps } = light;
  out.customProgramCacheKey = () => mirror ? 'atlas mirror' : 'atlas';
  out.onBeforeCompile = shader => {
    const insert = (from: string, at: string, text: string) => from.replace(at, `${at}\n${text}`);
    shader.uniforms.layers = light.layers;
    shader.uniforms.atlas = light.atlas;
    tellDistance(shader, mirrors.taking);
    Object.assign(shader.uniforms, lamps?.uniforms, mirror);
    shader.vertexShader = insert(shader.vertexShader, '#include <common>',
      `attribute vec2 atlasAt;\nvarying vec2 vAtlas;\nvarying vec3 vPlace;${lamps ? '\nattribute vec2 movedAt;\nvarying vec2 vMovedAt;\nvarying vec3 vFront;' : ''}`);
    shader.vertexShader = insert(shader.vertexShader, '#include <begin_vertex>', `vAtlas = atlasAt;
vPlace = (modelMatrix * vec4(position, 1.0)).xyz;${lamps ? `
vMovedAt = movedAt;
vFront = inverse(transpose(mat3(modelMatrix))) * normal;` : ''}`);
    shader.fragmentShader = insert(shader.fragmentShader, '#include <common>',
      `#define LAYERS ${light.layers.value.length}
uniform highp sampler2DArray atlas;
uniform vec4 layers[LAYERS];
varying vec2 vAtlas;
varying vec3 vPlace;${lamps ? `\nvarying vec2 vMovedAt;\nvarying vec3 vFront;\n${lampShader(lamps.lamps.length)}` : ''}${mirror ? mirrorShader : ''}`);
    shader.fragmentShader = insert(shader.fragmentShader, '#include <lights_fragment_maps>', `{${ofAtlas}${lamps ? ofDragged(lamps.lamps.length, mirror !== undefined) : ''}${addE} ${mirror ? mirrorRoom : mirrorMean}}`);
  };
  return out;
}
