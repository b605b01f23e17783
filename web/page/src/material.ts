import { type BufferGeometry, type MeshStandardMaterial } from 'three';
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

/** The material lit by the atlas; in the dark where a surface has no place in it. */
export function lit(material: MeshStandardMaterial, geometry: BufferGeometry, light: Light): MeshStandardMaterial {
  const out = material.clone();
  if (!geometry.hasAttribute('uv1')) return out;
  out.customProgramCacheKey = () => 'atlas';
  out.onBeforeCompile = shader => {
    const insert = (from: string, at: string, text: string) => from.replace(at, `${at}\n${text}`);
    shader.uniforms.layers = light.layers;
    shader.uniforms.atlas = light.atlas;
    shader.vertexShader = insert(shader.vertexShader, '#include <common>', 'attribute vec2 atlasAt;\nvarying vec2 vAtlas;');
    shader.vertexShader = insert(shader.vertexShader, '#include <begin_vertex>', 'vAtlas = atlasAt;');
    shader.fragmentShader = insert(shader.fragmentShader, '#include <common>',
      `#define LAYERS ${light.layers.value.length}
uniform highp sampler2DArray atlas;
uniform vec4 layers[LAYERS];
varying vec2 vAtlas;`);
    shader.fragmentShader = insert(shader.fragmentShader, '#include <lights_fragment_maps>', `{${ofAtlas}${addE}}`);
  };
  return out;
}
