import {
  AnimationMixer, Color, DataTexture, EquirectangularReflectionMapping, FloatType, LinearFilter, LoopOnce, Mesh,
  MeshBasicMaterial, MeshStandardMaterial, RepeatWrapping, RGBAFormat, Scene, SphereGeometry, type Material, type Object3D,
} from 'three';
import { GLTFLoader, type GLTF } from 'three/addons/loaders/GLTFLoader.js';
import type { Light } from './light';
import { lit } from './material';
import { Mirrors, tellDistance } from './mirrors';
import { Failure, type Manifest } from './manifest';

/** A lamp that is seen: its colour as in the file, and what it is multiplied with. */
interface Emitter { color: Color; file: Color; scale: Color }

interface EnvironmentExtras {
  color?: number[];
  rotation?: number;
  image?: { bufferView: number; width: number; height: number };
}

function groupOf(object: Object3D | null): string | undefined {
  for (; object; object = object.parent) {
    const name: unknown = object.userData.light_group;
    if (typeof name === 'string') return name;
  }
  return undefined;
}

/** The scene as it is shown: surfaces lit by `light`, lamps, the sky, and what moves. */
export class World {
  readonly scene = new Scene();
  private readonly emitters: Emitter[] = [];
  /** Lamps that are balls, by light group. */
  readonly balls = new Map<string, Mesh>();
  readonly mirrors: Mirrors;
  private readonly mixer: AnimationMixer;
  private skyScale: Color | undefined;

  private constructor(gltf: GLTF, private readonly manifest: Manifest, private readonly light: Light, mirroring: boolean) {
    this.scene.add(gltf.scene);
    this.mixer = new AnimationMixer(gltf.scene);
    for (const clip of gltf.animations) {
      const action = this.mixer.clipAction(clip);
      action.setLoop(LoopOnce, 1);
      action.clampWhenFinished = true;
      action.play();
    }
    const objects: Object3D[] = [];
    gltf.scene.traverse(object => objects.push(object));
    const known = new Map<string, Material>();
    this.scene.updateMatrixWorld(true);
    const surfaces = objects.filter((object): object is Mesh => object instanceof Mesh && object.geometry.hasAttribute('uv1'));
    this.mirrors = new Mirrors(mirroring ? surfaces : []);
    for (const object of objects) {
      if ('isLight' in object) this.replaceLamp(object);
      if (object instanceof Mesh) this.dress(object, known);
    }
    this.show(manifest.time);
  }

  /** `mirroring`: whether the graphics card draws into pictures of half floats. */
  static async load(manifest: Manifest, light: Light, mirroring: boolean): Promise<World> {
    const gltf = await new GLTFLoader().loadAsync(manifest.scene).catch((error: unknown) => {
      throw new Failure(`${manifest.scene} cannot be read: ${error}`);
    });
    const world = new World(gltf, manifest, light, mirroring);
    await world.addSky(gltf);
    return world;
  }

  /** Poses what moves, and takes the lamps' factors. */
  show(time: number): void {
    this.mixer.setTime(time);
    this.light.update(time);
    this.mirrors.stale = true;
    for (const { color, file, scale } of this.emitters) color.copy(file).multiply(scale);
    for (const lamp of this.light.lamps?.lamps ?? []) {
      const ball = this.balls.get(lamp.data.group);
      if (!ball) continue;
      ball.position.copy(ball.parent!.worldToLocal(lamp.at.clone()));
    }
    // A background has one factor: lamps keep their colour, the sky only its brightness.
    if (this.skyScale) this.scene.backgroundIntensity = (this.skyScale.r + this.skyScale.g + this.skyScale.b) / 3;
  }

  private dress(mesh: Mesh, known: Map<string, Material>): void {
    const material = mesh.material as Material;
    if (!(material instanceof MeshStandardMaterial)) return;
    for (const texture of [material.map, material.normalMap, material.roughnessMap, material.metalnessMap])
      if (texture) texture.anisotropy = 16;  // as much of it as there is
    const glows = material.emissive.getHex() !== 0 || material.emissiveMap !== null, group = glows ? groupOf(mesh) : undefined;
    const inAtlas = mesh.geometry.hasAttribute('uv1'), mirror = this.mirrors.of(mesh), key = `${material.uuid} ${inAtlas} ${group} ${mirror?.mirror.value.uuid}`;
    if (inAtlas) mesh.geometry.setAttribute('atlasAt', mesh.geometry.getAttribute('uv1'));
    if (inAtlas && this.light.lamps) mesh.geometry.setAttribute('movedAt', this.light.lamps.place(mesh.geometry));
    let own = known.get(key) as MeshStandardMaterial | undefined;
    if (!own) {
      own = lit(material, mesh.geometry, this.light, this.mirrors, mirror);
      known.set(key, own);
      this.glow(own.emissive, group);
    }
    mesh.material = own;
  }

  private glow(color: Color, group: string | undefined): void {
    const scale = this.light.scaleOf(group);
    if (scale) this.emitters.push({ color, file: color.clone(), scale });
  }

  /** The light is in the lightmaps; of a lamp that is a ball its surface is seen. */
  private replaceLamp(object: Object3D): void {
    object.visible = false;
    const { ssphh, light_group: group } = object.userData as {
      ssphh?: { type: string; radius: number; radiance?: number }; light_group?: string };
    if (ssphh?.type !== 'sphere' || !object.parent) return;
    const { color, intensity } = object as unknown as { color: Color; intensity: number };
    const radiance = ssphh.radiance ?? intensity / (Math.PI * ssphh.radius ** 2);
    const ball = new Mesh(new SphereGeometry(ssphh.radius, 32, 16), new MeshBasicMaterial({ color: color.clone().multiplyScalar(radiance) }));
    ball.material.onBeforeCompile = shader => tellDistance(shader, this.mirrors.taking);
    object.getWorldPosition(ball.position);
    this.scene.attach(ball);
    object.parent.attach(ball);
    this.balls.set(group ?? object.name, ball);
    this.glow(ball.material.color, group ?? object.name);
  }

  private async addSky(gltf: GLTF): Promise<void> {
    const sky = (gltf.scene.userData as { ssphh?: { environment?: EnvironmentExtras } }).ssphh?.environment;
    if (!sky) return;
    const factor = new Color().fromArray(sky.color ?? [1, 1, 1]);
    this.skyScale = this.light.scaleOf(this.manifest.environment_group);
    if (!sky.image) {
      this.scene.background = factor;
      if (this.skyScale) this.emitters.push({ color: this.scene.background, file: factor.clone(), scale: this.skyScale });
      this.skyScale = undefined;
      return;
    }
    const { bufferView, width, height } = sky.image;
    const rgb = new Float32Array(await gltf.parser.getDependency('bufferView', bufferView) as ArrayBuffer);
    const rgba = new Float32Array(4 * width * height);
    // Rows from the bottom, as the sampler of equirectangular pictures wants them.
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x)
        for (let c = 0; c < 3; ++c) rgba[4 * ((height - 1 - y) * width + x) + c] = rgb[3 * (y * width + x) + c]! * factor.toArray()[c]!;
    const picture = new DataTexture(rgba, width, height, RGBAFormat, FloatType);
    Object.assign(picture, { mapping: EquirectangularReflectionMapping, magFilter: LinearFilter, minFilter: LinearFilter,
      wrapS: RepeatWrapping, needsUpdate: true });
    this.scene.background = picture;
    this.scene.backgroundRotation.y = sky.rotation ?? 0;
  }
}
