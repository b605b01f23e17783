import { Color, CustomToneMapping, LinearToneMapping, Matrix4, PerspectiveCamera, ShaderChunk, WebGLRenderer, type Vector3 } from 'three';
import { readAtlas } from './atlas';
import { Handle, addressOf, placesIn } from './handles';
import { Lamps, type Lamp } from './lamps';
import { Light } from './light';
import { Failure, readManifest, type Manifest, type View } from './manifest';
import { Walk } from './walk';
import { World } from './world';

function element<E extends HTMLElement>(id: string): E {
  return document.getElementById(id) as E;
}
const stage = element('stage'), canvas = element<HTMLCanvasElement>('view'), message = element('message'), panel = element('panel');
const truth = element<HTMLImageElement>('truth'), wipe = element('wipe'), wipeAt = element<HTMLInputElement>('wipe-at');
const cameraList = element<HTMLSelectElement>('camera'), exposure = element<HTMLInputElement>('exposure');
const timeRow = element('time-row'), time = element<HTMLInputElement>('time'), compare = element<HTMLButtonElement>('compare');

// image::ToneCurve::filmic of the tool, digit for digit.
ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(
  'vec3 CustomToneMapping( vec3 color ) { return color; }',
  `vec3 CustomToneMapping( vec3 color ) {
    vec3 x = min( color * toneMappingExposure, vec3( 1e4 ) );
    return saturate( ( x * ( 2.51 * x + 0.03 ) ) / ( x * ( 2.43 * x + 0.59 ) + 0.14 ) );
  }`);

const shortcuts: [string, string][] = [
  ['W A S D, ↑ ↓', 'walk, on the level'], ['← →', 'turn'], ['Q E', 'down, up'], ['Shift', 'with keys: faster; with dragging: turn on the spot'],
  ['Tab to a lamp’s ring, ← → ↑ ↓, Page Up, Page Down', 'move the lamp, where it can be; with Shift by less'],
  ['1 … 9', 'cameras'], ['[ ]', 'exposure'], [', .', 'time, where something moves'], ['T', 'truth beside it, where there is a picture'],
  ['R', 'all as it was'], ['H', 'controls away and back'], ['?', 'these keys'],
];

function say(text: string): void {
  message.textContent = text;
  message.hidden = text === '';
}

class Page {
  private readonly camera = new PerspectiveCamera(50, 1, 0.01, 1000);
  private readonly walk: Walk;
  private view: View;
  private waiting = false;
  private last = 0;
  private fast = false;
  private readonly handles: Handle[];

  constructor(private readonly manifest: Manifest, private readonly renderer: WebGLRenderer, private readonly light: Light, private readonly world: World) {
    this.view = manifest.cameras[0]!;
    this.walk = new Walk(this.camera, canvas, () => {
      if (!wipe.hidden) this.endWipe();
      this.draw();
    });
    const lamps = this.light.lamps?.lamps ?? [];
    this.handles = lamps.map(lamp => new Handle(lamp, this.camera, canvas, element('handles'), (moved, to) => void this.move(moved, lamp.lattice.go(lamp.at, to))));
    this.fill();
    this.listen();
    this.takeAddress();
    panel.hidden = false;
    this.folded = window.matchMedia('(max-width: 40rem)').matches;
    this.choose(0);
  }

  private fill(): void {
    document.title = element('title').textContent = this.manifest.title;
    this.manifest.cameras.forEach((view, i) => cameraList.append(new Option(view.name, String(i))));
    for (const [key, about] of shortcuts) {
      const rows = [document.createElement('dt'), document.createElement('dd')] as const;
      rows[0].textContent = key, rows[1].textContent = about;
      element('keys').append(...rows);
    }
    const { times } = this.manifest;
    if (times.length > 1) {
      timeRow.hidden = false;
      time.min = String(times[0]), time.max = String(times.at(-1));
      time.value = String(this.manifest.time);
    }
    this.manifest.lightmap.groups.forEach((group, g) => element('lights').append(this.lamp(group.name, g)));
  }

  /** A row of the lights: brightness in stops, the lowest of which is off, and colour. */
  private lamp(name: string, g: number): HTMLElement {
    const row = document.createElement('div'), label = document.createElement('label'), out = document.createElement('output');
    const bright = document.createElement('input'), tint = document.createElement('input');
    row.className = 'lamp';
    Object.assign(bright, { type: 'range', min: '0', max: '2', step: '0.01', defaultValue: '1' });
    Object.assign(tint, { type: 'color', defaultValue: '#ffffff' });
    tint.setAttribute('aria-label', `Colour of ${name}`);
    const take = () => {
      out.textContent = `× ${Number(bright.value).toFixed(2)}`;
      this.light.scales[g]!.copy(new Color(tint.value)).multiplyScalar(Number(bright.value));
      this.endWipe();
      this.pose();
    };
    bright.addEventListener('input', take);
    tint.addEventListener('input', take);
    bright.dataset.group = tint.dataset.group = name;
    label.append(name, ' ', out, bright);
    row.append(label, tint);
    out.textContent = '× 1.00';
    return row;
  }

  private listen(): void {
    cameraList.addEventListener('change', () => this.choose(Number(cameraList.value)));
    exposure.addEventListener('input', () => { this.endWipe(); this.draw(); });
    time.addEventListener('input', () => { this.endWipe(); this.pose(); });
    compare.addEventListener('click', () => wipe.hidden ? this.startWipe() : this.endWipe());
    wipeAt.addEventListener('input', () => stage.style.setProperty('--cut', `${wipeAt.value}%`));
    element('reset').addEventListener('click', () => this.reset());
    element('fold').addEventListener('click', () => { this.folded = !this.folded; });
    element('help-button').addEventListener('click', () => element<HTMLDialogElement>('help').showModal());
    element('controls').addEventListener('submit', event => event.preventDefault());
    window.addEventListener('resize', () => this.draw());
    window.addEventListener('hashchange', () => this.takeAddress());
    window.addEventListener('keydown', event => this.key(event));
    window.addEventListener('keyup', event => { this.fast = event.shiftKey; });
    canvas.addEventListener('webglcontextlost', event => {
      event.preventDefault();
      say('The graphics card gave up. Load the page again.');
    });
  }

  private key(event: KeyboardEvent): void {
    this.fast = event.shiftKey;
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || element<HTMLDialogElement>('help').open || target.tagName === 'SELECT') return;
    const step = (input: HTMLInputElement, by: number) => {
      input.value = String(Number(input.value) + by);
      input.dispatchEvent(new Event('input'));
    };
    const timeStep = (Number(time.max) - Number(time.min)) / 40;
    const actions: Record<string, () => void> = {
      '?': () => element<HTMLDialogElement>('help').showModal(), '[': () => step(exposure, -0.5), ']': () => step(exposure, 0.5),
      ',': () => step(time, -timeStep), '.': () => step(time, timeStep), t: () => { if (!compare.hidden) compare.click(); },
      r: () => this.reset(), h: () => { this.folded = !this.folded; },
    };
    const digit = Number(event.key);
    if (digit >= 1 && digit <= this.manifest.cameras.length) this.choose(digit - 1);
    else if (actions[event.key.toLowerCase()]) actions[event.key.toLowerCase()]!();
    else return;
    event.preventDefault();
  }

  private get folded(): boolean { return element('controls').classList.contains('folded'); }
  private set folded(on: boolean) {
    element('controls').classList.toggle('folded', on);
    element('fold').setAttribute('aria-expanded', String(!on));
  }

  private choose(i: number): void {
    this.endWipe();
    this.view = this.manifest.cameras[i]!;
    cameraList.value = String(i);
    exposure.value = String(this.view.exposure);
    compare.hidden = !this.view.truth;
    this.home();
    this.pose();
  }

  private home(): void {
    new Matrix4().fromArray(this.view.world).decompose(this.camera.position, this.camera.quaternion, this.camera.scale);
    this.camera.scale.set(1, 1, 1);
    this.walk.distance = 2;
  }

  private reset(): void {
    for (const input of element('lights').querySelectorAll('input')) {
      input.value = input.defaultValue;
      input.dispatchEvent(new Event('input'));
    }
    for (const { lamp } of this.handles) lamp.at.copy(lamp.home);
    if (location.hash) history.replaceState(null, '', location.pathname + location.search);
    time.value = String(this.manifest.time);
    this.choose(Number(cameraList.value));
  }

  /** Lamps stand where the address says, if they may. */
  private takeAddress(): void {
    for (const [lamp, at] of placesIn(location.hash.slice(1), this.handles.map(handle => handle.lamp)))
      if (lamp.lattice.isFree(at)) void this.move(lamp, at);
  }

  /** Takes a lamp to a place where it may be; the first time, its light is fetched before. */
  private async move(lamp: Lamp, to: Vector3): Promise<void> {
    if (lamp.light.length === 0) {
      say(`Light of ${lamp.data.name}`);
      await this.light.lamps!.load(lamp).then(() => say(''), (error: unknown) => {
        say(`${lamp.data.name} stays where it is: ${error instanceof Failure ? error.message : error}`);
        throw error;
      });
    }
    lamp.at.copy(to);
    history.replaceState(null, '', `#${addressOf(this.light.lamps!.lamps)}`);
    this.endWipe();
    this.pose();
  }

  /** The wipe shows what the picture shows: its camera, time, exposure and lamps. */
  private startWipe(): void {
    const picture = this.view.truth;
    if (!picture) return;
    this.reset();
    truth.src = picture.file;
    truth.alt = `The same view path traced, ${picture.samples} samples a pixel`;
    truth.hidden = wipe.hidden = false;
    compare.setAttribute('aria-pressed', 'true');
    stage.style.setProperty('--cut', `${wipeAt.value}%`);
    this.draw();
    wipeAt.focus();
  }

  private endWipe(): void {
    truth.hidden = wipe.hidden = true;
    compare.setAttribute('aria-pressed', 'false');
    this.draw();
  }

  private pose(): void {
    element('time-text').textContent = `${Number(time.value).toFixed(2)} s`;
    this.world.show(this.manifest.times.length > 1 ? Number(time.value) : this.manifest.time);
    this.draw();
  }

  /** The whole window, or the shape of the truth that lies over it. */
  private fit(): void {
    let { innerWidth: width, innerHeight: height } = window;
    const whole = [width, height] as const;
    if (!wipe.hidden && this.view.truth) {
      const shape = this.view.truth.width / this.view.truth.height;
      [width, height] = width / height > shape ? [height * shape, height] : [width, width / shape];
    }
    const place = { left: (whole[0] - width) / 2, top: (whole[1] - height) / 2, width, height };
    for (const [name, value] of Object.entries(place)) stage.style.setProperty(`--${name}`, `${value}px`);
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.fov = this.view.yfov * 180 / Math.PI;
    this.camera.updateProjectionMatrix();
  }

  private draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(now => this.frame(now));
  }

  private frame(now: number): void {
    this.waiting = false;
    if (this.walk.busy) {
      this.walk.step(Math.min(0.1, this.last > 0 ? (now - this.last) / 1000 : 0.016), this.fast);
      this.draw();
    }
    this.last = this.walk.busy ? now : 0;
    element('exposure-text').textContent = `${Number(exposure.value).toFixed(1)} EV`;
    this.fit();
    this.light.lamps?.look(this.renderer, this.world.scene, Number(time.value), this.world.balls.values());
    this.world.mirrors.look(this.renderer, this.world.scene);
    this.renderer.toneMapping = this.manifest.tone_curve === 'filmic' ? CustomToneMapping : LinearToneMapping;
    this.renderer.toneMappingExposure = 2 ** Number(exposure.value);
    this.renderer.render(this.world.scene, this.camera);
    this.handles.forEach(handle => handle.show());  // by the matrices of this frame
    document.body.dataset.drawn = 'yes';
  }
}

async function start(): Promise<void> {
  if (!('DecompressionStream' in window)) throw new Failure('This browser is too old: it lacks DecompressionStream (browsers since 2023 have it).');
  const context = canvas.getContext('webgl2', { antialias: true, powerPreference: 'high-performance' });
  if (!context)
    throw new Failure('This browser shows no WebGL 2, which the scene needs. Try another browser, or allow the graphics card in its settings.');
  const manifest = await readManifest();
  const { width, height, groups } = manifest.lightmap, side = context.getParameter(context.MAX_TEXTURE_SIZE) as number;
  if (Math.max(width, height) > side)
    throw new Failure(`The lightmaps are ${width} × ${height} texels, and this graphics card takes ${side}. Write them with --size ${side}.`);
  const layers = groups.length * manifest.times.length, most = context.getParameter(context.MAX_ARRAY_TEXTURE_LAYERS) as number;
  if (layers > most) throw new Failure(`There are ${layers} lightmaps, and this graphics card takes ${most}. Write them with fewer --poses, or --merge-groups.`);
  const renderer = new WebGLRenderer({ canvas, context, antialias: true });
  const atlas = await readAtlas(manifest, share => say(`Light ${Math.round(100 * share)} %`));
  const light = new Light(manifest, atlas, await Lamps.read(manifest));
  say('Scene');
  const half = context.getExtension('EXT_color_buffer_float') ?? context.getExtension('EXT_color_buffer_half_float');
  const world = await World.load(manifest, light, half !== null);
  say('');
  new Page(manifest, renderer, light, world);
}

say('Loading');
start().catch((error: unknown) => {
  say(error instanceof Failure ? error.message : `The page failed: ${error}`);
  panel.hidden = true;
  document.body.dataset.failed = 'yes';
});
