// What the mode draws besides handles: the mesh and the edges of the model; the picture that the mesh is for, and a second view.
import { computed, signal, untracked } from '@preact/signals';
import { Matrix4, Vector3 } from 'three';
import type { Change } from 'soapfilm/surfaces';
import { FatLines } from '../../scene/fat_line.ts';
import { Inset, kInsetLayer } from '../../scene/inset.ts';
import type { ModeScene } from '../../scene/mode_scene.ts';
import type { Placement } from '../../scene/placement.ts';
import type { Stage } from '../../scene/stage.ts';
import { add, boundsOf, scale } from '../../shapes/vec.ts';
import { boxOfGroup } from '../../state/document.ts';
import { mode, shown } from '../../state/store.ts';
import { coloring, view } from './looks.ts';
import { frozen, meshed, model, picture, settings, type Picture } from './meshing.ts';
import { paint } from './paint.ts';
import { kMode } from './settings.ts';
import { SurfaceMesh } from './surface_mesh.ts';

/** In CSS pixels. */
const kEdge = 1.6;
/** A moving camera asks for a mesh so often. */
const kPictureMs = 100;

/** Bytes sent to the graphics card for the last mesh. */
export const uploaded = signal(0);

/** Draws from now on whatever there is. */
export function drawSurfaces(stage: Stage, scene: ModeScene): void {
  const { theme } = stage;
  const { root, placement, viewpoint } = scene;
  const surface = new SurfaceMesh();
  const edges = new FatLines();
  root.add(surface.object, edges.object);
  stage.view.follow(() => {
    const { surface: colors } = theme.value;
    const look = {
      front: colors.front,
      back: colors.back,
      wire: colors.wire,
      wires: shown.value.wires,
      smooth: view.value.smooth,
      checks: coloring.value === 'checks',
      paint: (mesh: Change['mesh']) => paint(coloring.value, mesh, meshed.value?.of.model ?? {}),
    };
    surface.update(meshed.value?.change ?? null, look);
    uploaded.value = surface.uploaded;
  });
  stage.view.follow(() => {
    const { center, unit } = placement.value;
    const [x, y, z] = meshed.value?.change.mesh.origin ?? [0, 0, 0];
    surface.object.position.set((x - center[0]) / unit, (y - center[1]) / unit, (z - center[2]) / unit);
    surface.object.scale.setScalar(1 / unit);
  });
  stage.view.follow(() => {
    edges.clear();
    const now = meshed.value;
    if (now === null || !view.value.edges) return;
    edges.put(segmentsOf(now.change, placement.value), { color: theme.value.curves.line, width: kEdge });
  });
  drawSecond(stage, scene);
  const take = (): void => {
    if (mode.peek() !== kMode) return;
    const { camera } = viewpoint;
    camera.updateMatrixWorld();
    const { center, unit } = placement.peek();
    const toScene = new Matrix4().makeScale(1 / unit, 1 / unit, 1 / unit).multiply(new Matrix4().makeTranslation(-center[0], -center[1], -center[2]));
    const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld).applyMatrix4(toScene.clone().invert());
    const viewProjection = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(toScene);
    const [width, height] = stage.view.size;
    const next = { eye: eye.toArray(), viewProjection: viewProjection.toArray(), width, height };
    if (JSON.stringify(picture.peek()) !== JSON.stringify(next)) picture.value = next;
  };
  let timer: ReturnType<typeof setTimeout> | undefined;
  const look = (): void => {
    if (timer !== undefined) return;
    timer = setTimeout(() => {
      timer = undefined;
      if (!frozen.peek()) take();
    }, kPictureMs);
  };
  stage.view.onCamera(look);
  const follows = computed(() => settings.value.follows);
  stage.view.follow(() => {
    if (!follows.value) return;
    // Frozen is the picture at that moment, not one up to `kPictureMs` older.
    if (frozen.value) untracked(take);
    else look();
  });
}

/** The second view: how the mesh is elsewhere, while it follows the camera; with what the camera sees. */
function drawSecond({ view: screen, theme }: Stage, { root, placement, viewpoint, options }: ModeScene): void {
  const inset = new Inset(screen, 'Second view');
  const frustum = new FatLines();
  root.add(frustum.object);
  let framed: unknown = null;
  screen.follow(() => {
    const isShown = mode.value === kMode && settings.value.follows && view.value.second && model.value !== null;
    inset.viewpoint.place(placement.value);
    inset.show(isShown);
    if (!isShown || framed === model.value) return;
    framed = model.value;
    const box = boxOfGroup(options.group.peek());
    inset.viewpoint.follow(boundsOf(box).diagonal / 2, true);
    // From beside the camera, and above it: what it sees is then seen from the side.
    const { right, toViewer } = viewpoint.axes();
    inset.viewpoint.frame(box, add(add(toViewer, scale(right, 0.9)), [0, 0, 0.5]), true);
  });
  screen.follow(() => {
    frustum.clear();
    const now = picture.value;
    if (now === null || !settings.value.follows) return;
    frustum.put(frustumOf(now, placement.value), { color: theme.value.curves.selected, width: kEdge });
    frustum.object.traverse((object) => { object.layers.set(kInsetLayer); });
  });
}

/** The pyramid that a picture shows, as far as the middle of the scene. */
function frustumOf({ eye, viewProjection }: Picture, { center, unit }: Placement): Float32Array {
  const toWorld = new Matrix4().fromArray(viewProjection).invert();
  const inScene = (p: Vector3): Vector3 => p.set((p.x - center[0]) / unit, (p.y - center[1]) / unit, (p.z - center[2]) / unit);
  const from = inScene(new Vector3(...eye));
  const reach = Math.max(from.length(), 1e-3);
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) =>
    inScene(new Vector3(x, y, 0).applyMatrix4(toWorld)).sub(from).normalize().multiplyScalar(reach).add(from),
  );
  return Float32Array.from(corners.flatMap((corner, k) => [from, corner, corner, corners[(k + 1) % 4]].flatMap((p) => p.toArray())));
}

/** The edges of a mesh as segments in the scene. */
function segmentsOf({ mesh }: Change, { center, unit }: Placement): Float32Array {
  const { edges, edgeStarts, positions, origin } = mesh;
  const ends: number[] = [];
  for (let e = 0; e + 1 < edgeStarts.length; e++) {
    for (let i = edgeStarts[e]; i + 1 < edgeStarts[e + 1]; i++) {
      for (const v of [edges[i], edges[i + 1]]) {
        for (let axis = 0; axis < 3; axis++) ends.push((positions[3 * v + axis] + origin[axis] - center[axis]) / unit);
      }
    }
  }
  return Float32Array.from(ends);
}
