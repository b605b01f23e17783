import { PerspectiveCamera, Spherical, Vector3 } from 'three';

const keys: Record<string, [number, number, number]> = {  // right, up, ahead
  KeyW: [0, 0, 1], ArrowUp: [0, 0, 1], KeyS: [0, 0, -1], ArrowDown: [0, 0, -1],
  KeyA: [-1, 0, 0], KeyD: [1, 0, 0], KeyE: [0, 1, 0], KeyQ: [0, -1, 0],
};
const turns: Record<string, number> = { ArrowLeft: 1, ArrowRight: -1 };
const speed = 1.6, turnSpeed = 1.5, steepest = Math.PI / 2 - 0.01;  // m/s, radians/s

/** Moves a camera by keys, pointers and the wheel: turning about the place ahead, or about itself with Shift. */
export class Walk {
  private readonly held = new Set<string>();
  private readonly pointers = new Map<number, [number, number]>();
  private pan = false;
  private spread = 0;
  distance = 2;  // to what is turned about [m]

  constructor(private readonly camera: PerspectiveCamera, private readonly canvas: HTMLCanvasElement, private readonly moved: () => void) {
    window.addEventListener('keydown', event => {
      if (event.ctrlKey || event.metaKey || event.altKey || !(event.code in keys || event.code in turns)) return;
      const taken = (event.target as HTMLElement).closest(event.code.startsWith('Arrow') ? 'input, select, dialog, .handle' : 'select, dialog');
      if (taken) return;
      event.preventDefault();
      this.held.add(event.code);
      moved();
    });
    window.addEventListener('keyup', event => this.held.delete(event.code));
    window.addEventListener('blur', () => this.held.clear());
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      this.pan = event.button === 2;
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
      this.spread = this.gap();
    });
    for (const end of ['pointerup', 'pointercancel'] as const)
      canvas.addEventListener(end, event => {
        this.pointers.delete(event.pointerId);
        this.spread = this.gap();
      });
    canvas.addEventListener('pointermove', event => this.drag(event));
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.nearer(Math.exp(-event.deltaY / 1000));
    }, { passive: false });
  }

  get busy(): boolean { return this.held.size > 0; }

  /** One step of `seconds` by the keys that are held. */
  step(seconds: number, fast: boolean): void {
    const way = new Vector3();
    let turn = 0;
    for (const code of this.held) {
      const [right, up, ahead] = keys[code] ?? [0, 0, 0];
      way.add(new Vector3(right, up, -ahead));
      turn += turns[code] ?? 0;
    }
    const ahead = new Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion);
    way.clampLength(0, 1).multiplyScalar((fast ? 4 : 1) * speed * seconds);
    this.camera.position.add(way.applyAxisAngle(new Vector3(0, 1, 0), Math.atan2(-ahead.x, -ahead.z)));
    if (turn) this.turn(turn * turnSpeed * seconds, 0, 0);
  }

  private gap(): number {
    const [a, b] = [...this.pointers.values()];
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  private drag(event: PointerEvent): void {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last[0], dy = event.clientY - last[1], share = 1 / this.canvas.clientHeight;
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size === 2) {
      const gap = this.gap();
      if (this.spread > 0 && gap > 0) this.nearer(gap / this.spread);
      this.spread = gap;
    }
    if (this.pan || this.pointers.size === 2) {
      const scale = this.distance * share / this.pointers.size;
      this.camera.translateX(-dx * scale);
      this.camera.translateY(dy * scale);
    } else {
      this.turn(-dx * 3 * share, -dy * 3 * share, event.shiftKey ? 0 : this.distance);
    }
    this.moved();
  }

  private nearer(factor: number): void {
    const before = this.distance;
    this.distance = Math.max(0.05, before / factor);
    this.camera.translateZ(this.distance - before);
    this.moved();
  }

  private turn(yaw: number, pitch: number, about: number): void {
    const ahead = new Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion);
    const middle = this.camera.position.clone().addScaledVector(ahead, about);
    const way = new Spherical().setFromVector3(ahead);
    way.theta += yaw;
    way.phi = Math.PI / 2 - Math.min(steepest, Math.max(-steepest, Math.PI / 2 - way.phi + pitch));
    const to = new Vector3().setFromSpherical(way);
    this.camera.position.copy(middle).addScaledVector(to, -about);
    this.camera.up.set(0, 1, 0);
    this.camera.lookAt(this.camera.position.clone().add(to));
  }
}
