import type { CookedLight, PlaceKind } from '../cooked/light.js';
import { SsphhError } from '../errors.js';
import { probeLightChunk } from './chunk.js';

export { lightTextures, probeLightChunk, type LightChunk, type LightTexture, type LightTextures } from './chunk.js';

/** What of three's `Material` is used here, so that no type of three is needed. */
export interface LitMaterial {
  type: string;
  needsUpdate: boolean;
  onBeforeCompile(parameters: ShaderParameters, ...rest: never[]): void;
  customProgramCacheKey(): string;
  onBeforeRender(...parameters: never[]): void;
}
export interface ShaderParameters {
  uniforms: Record<string, { value: unknown }>;
  vertexShader: string;
  fragmentShader: string;
}

export interface ProbeLightOptions {
  /** `still` (the default): meshes that stand where they stood at the bake. `open`: what moves, and what was not there. */
  kind?: PlaceKind;
  /** Factor on the light, as of lamps: 1. */
  intensity?: number;
}

const vertexHead = 'varying vec3 vSsphhPosition;\n';
const vertexPlace = /* glsl */ `
  vec4 ssphhPosition = vec4(transformed, 1.0);
  #ifdef USE_BATCHING
    ssphhPosition = batchingMatrix * ssphhPosition;
  #endif
  #ifdef USE_INSTANCING
    ssphhPosition = instanceMatrix * ssphhPosition;
  #endif
  vSsphhPosition = (modelMatrix * ssphhPosition).xyz;
`;
const fragmentLight = /* glsl */ `
#if defined( RE_IndirectDiffuse )
  irradiance += ssphhIntensity * ssphhIrradiance(vSsphhPosition, normalize((vec4(nonPerturbedNormal, 0.0) * viewMatrix).xyz),
    normalize((vec4(normal, 0.0) * viewMatrix).xyz));
#endif
`;

function after(shader: string, include: string, text: string, material: string): string {
  const line = `#include <${include}>`;
  if (!shader.includes(line)) throw new SsphhError('bad-argument', `a ${material} has no place for indirect light: its shader lacks ${line}`);
  return shader.replace(line, `${line}\n${text}`);
}

const applied = new WeakMap<LitMaterial, Pick<LitMaterial, 'onBeforeCompile' | 'customProgramCacheKey' | 'onBeforeRender'>>();

/**
 * Lights what is drawn with a material of three's (Lambert, Phong, Standard, Physical, Toon; WebGLRenderer) by a cooked file, pixel by pixel: the
 * lookup of `light.irradiance` with its weights and visibility, as indirect diffuse light. The scene stands in the bake's world: right-handed, y up,
 * metres. `light.setGroupScale` and `swapLight` show in the next picture. Calling it again replaces what was applied. Returns the material.
 */
export function applyProbeLight<M extends LitMaterial>(material: M, light: CookedLight, options: ProbeLightOptions = {}): M {
  removeProbeLight(material);
  const { kind = 'still', intensity = 1 } = options, chunk = probeLightChunk(light, kind);
  const { onBeforeCompile, customProgramCacheKey, onBeforeRender } = material;
  applied.set(material, { onBeforeCompile, customProgramCacheKey, onBeforeRender });
  const key = `ssphh ${light.info.geometry} ${kind}`;
  material.onBeforeCompile = function (this: M, shader: ShaderParameters, ...rest: never[]) {
    onBeforeCompile.call(this, shader, ...rest);
    Object.assign(shader.uniforms, chunk.uniforms, { ssphhIntensity: { value: intensity } });
    shader.vertexShader = after(vertexHead + shader.vertexShader, 'worldpos_vertex', vertexPlace, this.type);
    shader.fragmentShader = after(shader.fragmentShader, 'lights_fragment_begin', fragmentLight, this.type);
    shader.fragmentShader = after(shader.fragmentShader, 'common', `${vertexHead}uniform float ssphhIntensity;\n${chunk.functions}`, this.type);
  };
  material.customProgramCacheKey = function (this: M) {
    return `${key} ${customProgramCacheKey.call(this)}`;
  };
  material.onBeforeRender = function (this: M, ...parameters: never[]) {
    chunk.update();
    onBeforeRender.apply(this, parameters);
  };
  material.needsUpdate = true;
  return material;
}

/** Makes the material what it was before `applyProbeLight`. */
export function removeProbeLight<M extends LitMaterial>(material: M): M {
  const before = applied.get(material);
  if (!before) return material;
  Object.assign(material, before);
  applied.delete(material);
  material.needsUpdate = true;
  return material;
}
