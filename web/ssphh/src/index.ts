export { SsphhError, type ErrorCode } from './errors.js';
export type { Bytes, BytesSource } from './bytes.js';
export * from './sh.js';
export { openCooked, openCookedSync, CookedLight, type LightGroup, type LightInfo, type PlaceKind } from './cooked/light.js';
export { readSphl, probeRadiance, tangentsOf } from './sphl/read.js';
export type { Coefficients, FittedPoint, Generator, Position, Probe, ProbeLightGroup, ProbeSet, SurfaceRecords } from './sphl/types.js';
export { readGltfExtras, type GltfEmission, type GltfExtras, type GltfSphl } from './gltf.js';
