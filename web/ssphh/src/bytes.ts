import { SsphhError } from './errors.js';

/** Bytes as they lie in memory. */
export type Bytes = ArrayBuffer | ArrayBufferView;
/** What has bytes to give: a `Response` of `fetch`, a `Blob`, a `File`. */
export interface BytesSource {
  arrayBuffer(): Promise<ArrayBuffer>;
  /** Of a `Response`: whether it is one of success. */
  readonly ok?: boolean;
  readonly status?: number;
}

/** A view of all bytes, without a copy. Error `bad-argument` for anything else. */
export function viewOf(bytes: Bytes): Uint8Array {
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes);
  if (ArrayBuffer.isView(bytes)) return new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  throw new SsphhError('bad-argument', 'bytes must be an ArrayBuffer or a view of one');
}

/** The bytes of either kind. Error `bad-file` for a `Response` that is none of success. */
export async function fetchBytes(source: Bytes | BytesSource): Promise<Uint8Array> {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return viewOf(source);
  if (typeof source?.arrayBuffer !== 'function')
    throw new SsphhError('bad-argument', 'expected bytes, a Blob or a Response');
  if (source.ok === false) throw new SsphhError('bad-file', `the server answered ${source.status ?? 'with an error'}`);
  return new Uint8Array(await source.arrayBuffer());
}

const decoder = new (globalThis as unknown as { TextDecoder: new (label: string, options: object) => { decode(bytes: Uint8Array): string } })
  .TextDecoder('utf-8', { fatal: true, ignoreBOM: true });

/** Text of UTF-8 bytes; undefined where they are none. */
export function utf8(bytes: Uint8Array): string | undefined {
  try {
    return decoder.decode(bytes);
  } catch {
    return undefined;
  }
}
