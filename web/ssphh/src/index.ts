export { SsphhError, type ErrorCode } from './errors.js';
export type { Bytes, BytesSource } from './bytes.js';
export * from './sh.js';
export { openCooked, openCookedSync, CookedLight, type LightGroup, type LightInfo, type PlaceKind } from './cooked/light.js';
