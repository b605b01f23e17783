/** What is wrong with a file or an argument. The first five of a cooked file are those of the C run-time's `ssphh_runtime_open`. */
export type ErrorCode =
  | 'not-cooked'
  | 'bad-version'
  | 'cut-off'
  | 'damaged'
  | 'invalid'
  | 'other-geometry'
  | 'other-groups'
  | 'bad-argument'
  | 'not-sphl'
  | 'not-gltf'
  | 'bad-file';


/** Everything that this package throws by intent: `message` is a sentence for people, `code` is for programs. */
export class SsphhError extends Error {
  override readonly name = 'SsphhError';
  constructor(
    readonly code: ErrorCode,
    message: string,
  ) {
    super(message);
  }
}
