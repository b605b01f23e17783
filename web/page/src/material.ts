import { type BufferGeometry, type MeshStandardMaterial } from 'three';
import { lampShader } from './lamp_shader';
import type { Light } from './light';

// Irradiance E goes in as light from an environment that is E/π everywhere: the diffuse layer leaves ρ E/π of what the
// specular lobe lets through, and the lobe mirrors the mean of its hemisphere. Both are what the tool's BSDF does there.
const addE = `
  iblIrradiance += E;
  radiance += E * RECIPROCAL_PI;
`;
const ofAtlas = `
  vec3 E = vec3(0.0);
  for (int i = 0; i < LAYERS; ++i)
    if (layers[i].rgb != vec3(0.0)) E += layers[i].rgb * texture(atlas, vec3(vAtlas, layers[i].a)).rgb;
`;

// As in the lightmaps, smooth metals do not hold direct light: they show a lamp at one spot.
const ofDragged = `
  E += texture(moved, vMovedAt).rgb;
  E += ofLamps(vPlace, normalize(vFront)) * (1.0 - metalnessFactor * (1.0 - roughnessFactor * roughnessFactor));
`;

/** The material lit by the atlas; in the dark where a surface has no place in it. */
export function lit(material: MeshStandardMaterial, geometry: BufferGeometry, light: Light): MeshStandardMaterial {
  const out = material.clone();
  if (!geometry.hasAttribute('uv1')) return out;
  const { lamps } = light;
  out.customProgramCacheKey = () => 'atlas';
  out.onBeforeCompile = shader => {
    const insert = (from: string, at: string, text: string) => from.replace(at, `${at}\n${text}`);
    shader.uniforms.layers = light.layers;
    shader.uniforms.atlas = light.atlas;
    if (lamps) Object.assign(shader.uniforms, lamps.uniforms);
    shader.vertexShader = insert(shader.vertexShader, '#include <common>',
      `attribute vec2 atlasAt;\nvarying vec2 vAtlas;${lamps ? '\nattribute vec2 movedAt;\nvarying vec2 vMovedAt;\nvarying vec3 vPlace, vFront;' : ''}`);
    shader.vertexShader = insert(shader.vertexShader, '#include <begin_vertex>', `vAtlas = atlasAt;${lamps ? `
vMovedAt = movedAt;
vPlace = (modelMatrix * vec4(position, 1.0)).xyz;
vFront = inverse(transpose(mat3(modelMatrix))) * normal;` : ''}`);
    shader.fragmentShader = insert(shader.fragmentShader, '#include <common>',
      `#define LAYERS ${light.layers.value.length}
uniform highp sampler2DArray atlas;
uniform vec4 layers[LAYERS];
varying vec2 vAtlas;${lamps ? `\nvarying vec2 vMovedAt;\nvarying vec3 vPlace, vFront;\n${lampShader(lamps.lamps.length)}` : ''}`);
    shader.fragmentShader = insert(shader.fragmentShader, '#include <lights_fragment_maps>', `{${ofAtlas}${lamps ? ofDragged : ''}${addE}}`);
  };
  return out;
}
