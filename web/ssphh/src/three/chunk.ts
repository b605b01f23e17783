import { DataTexture, FloatType, NearestFilter, RGBAFormat, RGBAIntegerFormat, UnsignedIntType } from 'three';
import type { CookedLight, PlaceKind } from '../cooked/light.js';
import { groupFloats, probeFloats } from '../cooked/file.js';
import type { Header, SectionName } from '../cooked/layout.js';
import { SsphhError } from '../errors.js';
import { lookupGlsl } from './lookup.glsl.js';

const widthLog2 = 11, width = 1 << widthLog2, mostTexels = width * 16384;

/** What is known here of three's `DataTexture`. */
export interface LightTexture {
  needsUpdate: boolean;
  dispose(): void;
}

/** The file and its light on the graphics card, shared by all materials of a `CookedLight`. */
export class LightTextures {
  readonly file: LightTexture;
  readonly light: LightTexture;
  readonly #numbers: Float32Array;
  #version: number;

  constructor(readonly source: CookedLight) {
    const { bytes, header } = source.file, words = header.sections.light.offset / 4, floats = groupFloats(header);
    if (Math.max(words, floats) / 4 > mostTexels)
      throw new SsphhError('bad-argument', `a file with ${words * 4} bytes before its light fits in no texture: cook it with a smaller --sight`);
    const texels = new Uint32Array(padded(words));
    texels.set(new Uint32Array(bytes.buffer, bytes.byteOffset, words));
    this.#numbers = new Float32Array(padded(floats));
    const file = new DataTexture(texels, width, texels.length / 4 / width, RGBAIntegerFormat, UnsignedIntType);
    const light = new DataTexture(this.#numbers, width, this.#numbers.length / 4 / width, RGBAFormat, FloatType);
    file.internalFormat = 'RGBA32UI';
    this.file = file;
    this.light = light;
    for (const texture of [file, light]) {
      texture.minFilter = texture.magFilter = NearestFilter;
      texture.generateMipmaps = false;
      texture.needsUpdate = true;
    }
    this.#version = -1;
    this.update();
  }

  /** Takes over scales and light that have changed. */
  update(): void {
    if (this.#version === this.source.version) return;
    this.#version = this.source.version;
    this.source.summedLight(this.#numbers);
    this.light.needsUpdate = true;
  }

  dispose(): void {
    this.file.dispose();
    this.light.dispose();
  }
}

/** Whole rows of texels of four numbers. */
function padded(numbers: number): number {
  return Math.max(1, Math.ceil(numbers / 4 / width)) * width * 4;
}

const known = new WeakMap<CookedLight, LightTextures>();

/** The textures of a light, made when they are asked for first. `dispose()` frees the card's memory; they come back when they are used again. */
export function lightTextures(light: CookedLight): LightTextures {
  let textures = known.get(light);
  if (!textures) known.set(light, (textures = new LightTextures(light)));
  return textures;
}

/** A number as GLSL's float, all digits. */
function float(v: number): string {
  const text = String(v);
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/** What `lookupGlsl` asks of a file, as `file.glsl` beside it reads it from the header. */
function constants(h: Header): string {
  const vec = (numbers: ArrayLike<number>, w: number) => `vec4(${[...Array.from(numbers), w].map(float).join(', ')})`;
  const ivec = (numbers: readonly number[]) => `ivec3(${numbers.join(', ')})`;
  const section = (name: SectionName) => h.sections[name].offset / 16;
  const values: Record<string, string | number> = {
    DEGREE: h.degree, PROBE_TEXELS: h.probeStride / 4, SIGHT_SIZE: h.sightSize, LIST_LENGTH: h.probeListLength,
    SPACING: float(h.probeSpacing), PROBE_GRID: vec(h.probeOrigin, h.probeCellSize), PROBE_CELL_COUNTS: ivec(h.probeCells),
    PROBES: section('probes'), PROBE_CELLS: section('probeCells'), SIGHT: section('sight'), BRICKS: section('bricks'), CELLS: section('cells'),
    ENTRIES: section('entries'), MASKS: section('masks'), POINTS: section('points'), POINT_COUNT: h.pointCount, POINT_LIGHT: probeFloats(h) / 4,
    POINT_TEXELS: h.pointFloats / 4,
    NEAR_GRID: vec(h.grids[0].origin, h.grids[0].cellSize), NEAR_CELLS: ivec(h.grids[0].cells),
    FAR_GRID: vec(h.grids[1].origin, h.grids[1].cellSize), FAR_CELLS: ivec(h.grids[1].cells), FAR_BRICK: h.grids[1].firstBrick,
  };
  return Object.entries(values).map(([name, value]) => `#define SSPHH_${name} ${value}\n`).join('');
}

const accessGlsl = /* glsl */ `
uniform highp usampler2D ssphhFile;  // the cooked file up to its light, 16 bytes a texel
uniform highp sampler2D ssphhLight;  // of all groups: probes, then points

uvec4 ssphh_texel(int i) { return texelFetch(ssphhFile, ivec2(i & ${width - 1}, i >> ${widthLog2}), 0); }
#define SSPHH_TEXEL(i) ssphh_texel(i)
vec4 ssphh_light_texel(int i) { return texelFetch(ssphhLight, ivec2(i & ${width - 1}, i >> ${widthLog2}), 0); }
vec4 ssphh_probe_light(int probe, int colour, int k) { return ssphh_light_texel((probe * 3 + colour) * SSPHH_PROBE_TEXELS + k); }
vec4 ssphh_point_light(int point_index, int k) { return ssphh_light_texel(SSPHH_POINT_LIGHT + point_index * SSPHH_POINT_TEXELS + k); }
`;

const entryGlsl = (still: boolean) => /* glsl */ `
vec3 ssphhIrradiance(vec3 position, vec3 geometryNormal, vec3 shadingNormal) {
  return ssphh_irradiance_for(position, geometryNormal, shadingNormal, ${still});
}
`;

export interface LightChunk {
  /** `ssphhFile`, `ssphhLight`: textures. */
  uniforms: { ssphhFile: { value: LightTexture }; ssphhLight: { value: LightTexture } };
  /**
   * GLSL ES 3.00 for a fragment shader: `vec3 ssphhIrradiance(vec3 position, vec3 geometryNormal, vec3 shadingNormal)`, the irradiance [W/m²] at a
   * place of the world. Weights and sight are by the geometry's normal, light is for the shading one.
   */
  functions: string;
  /** To be called before each picture: takes over scales that were set. */
  update(): void;
}

/** The lookup of `CookedLight.irradiance` in GLSL, for own materials; those of three take `applyProbeLight`. */
export function probeLightChunk(light: CookedLight, kind: PlaceKind = 'still'): LightChunk {
  if (kind !== 'still' && kind !== 'open') throw new SsphhError('bad-argument', `a place is "still" or "open", not ${JSON.stringify(kind)}`);
  const textures = lightTextures(light);
  return {
    uniforms: { ssphhFile: { value: textures.file }, ssphhLight: { value: textures.light } },
    functions: constants(light.file.header) + accessGlsl + lookupGlsl + entryGlsl(kind === 'still'),
    update: () => textures.update(),
  };
}
