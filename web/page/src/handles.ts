import { PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { Lamp } from './lamps';

const step = 0.1, fineStep = 0.02;  // by keys [m]
const ways: Record<string, [number, number, number]> = {  // right, up, ahead
  ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 0, 1], ArrowDown: [0, 0, -1], PageUp: [0, 1, 0], PageDown: [0, -1, 0],
};

/** A ring in the picture by which a lamp is dragged. */
export class Handle {
  private readonly button = document.createElement('button');
  private grip: Vector2 | undefined;  // from the pointer to the lamp, while it is dragged [pixels]

  constructor(readonly lamp: Lamp, private readonly camera: PerspectiveCamera, private readonly canvas: HTMLCanvasElement, parent: HTMLElement, private readonly move: (lamp: Lamp, to: Vector3) => void) {
    const { button } = this;
    Object.assign(button, { type: 'button', className: 'handle', title: lamp.data.name });
    button.setAttribute('aria-label', `Move ${lamp.data.name}: arrows, Page Up and Page Down`);
    button.dataset.lamp = lamp.data.name;
    parent.append(button);
    button.addEventListener('pointerdown', event => {
      button.setPointerCapture(event.pointerId);
      const box = button.getBoundingClientRect();
      this.grip = new Vector2(box.x + box.width / 2 - event.clientX, box.y + box.height / 2 - event.clientY);
    });
    button.addEventListener('pointermove', event => { if (this.grip) this.drag(event.clientX + this.grip.x, event.clientY + this.grip.y); });
    for (const end of ['pointerup', 'pointercancel'] as const) button.addEventListener(end, () => { this.grip = undefined; });
    button.addEventListener('keydown', event => {
      const way = ways[event.code];
      if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      const ahead = new Vector3(0, 0, -1).applyQuaternion(camera.quaternion), to = new Vector3(way[0], way[1], -way[2]);
      to.applyAxisAngle(new Vector3(0, 1, 0), Math.atan2(-ahead.x, -ahead.z)).multiplyScalar(event.shiftKey ? fineStep : step);
      move(lamp, to.add(lamp.at));
    });
  }

  /** In the plane through the lamp that faces the camera. */
  private drag(x: number, y: number): void {
    const box = this.canvas.getBoundingClientRect(), ray = new Raycaster();
    ray.setFromCamera(new Vector2(2 * (x - box.x) / box.width - 1, 1 - 2 * (y - box.y) / box.height), this.camera);
    const plane = new Plane().setFromNormalAndCoplanarPoint(new Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion), this.lamp.at);
    const to = ray.ray.intersectPlane(plane, new Vector3());
    if (to) this.move(this.lamp, to);
  }

  /** Follows the lamp; away while it is behind or beside the picture. */
  show(): void {
    const at = this.lamp.at.clone().project(this.camera), box = this.canvas.getBoundingClientRect();
    this.button.hidden = at.z > 1 || Math.abs(at.x) > 1 || Math.abs(at.y) > 1;
    this.button.style.left = `${box.x + box.width * (at.x + 1) / 2}px`;
    this.button.style.top = `${box.y + box.height * (1 - at.y) / 2}px`;
  }
}

/** Places of lamps that moved as the part of an address behind `#`, and back. */
export function addressOf(lamps: Lamp[]): string {
  return lamps.filter(lamp => lamp.moved).map(({ data, at }) => `${encodeURIComponent(data.name)}=${at.toArray().map(x => x.toFixed(3)).join(',')}`).join('&');
}
export function placesIn(address: string, lamps: Lamp[]): [Lamp, Vector3][] {
  const found: [Lamp, Vector3][] = [];
  for (const [name, place] of new URLSearchParams(address)) {
    const lamp = lamps.find(({ data }) => data.name === name), numbers = place.split(',').map(Number);
    if (lamp && numbers.length === 3 && numbers.every(Number.isFinite)) found.push([lamp, new Vector3().fromArray(numbers)]);
  }
  return found;
}
