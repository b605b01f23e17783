// The little of three that this package calls: it is no dependency, and brings no types of its own.
declare module 'three' {
  export class DataTexture {
    constructor(data: Uint32Array | Float32Array, width: number, height: number, format: number, type: number);
    internalFormat: string | null;
    minFilter: number;
    magFilter: number;
    generateMipmaps: boolean;
    needsUpdate: boolean;
    dispose(): void;
  }
  export const FloatType: number, NearestFilter: number, RGBAFormat: number, RGBAIntegerFormat: number, UnsignedIntType: number;
}
