// Puts the page together: the scene, the tools, the keys, the panels, and the mode that the address asks for.
import { render } from 'preact';
import { computed } from '@preact/signals';
import { actionsOf } from './app/core_actions.ts';
import { App } from './app/app.tsx';
import { attachKeyboard } from './app/keyboard.ts';
import { current, startRooms } from './app/rooms.ts';
import { kModes } from './modes/index.ts';
import { Stage } from './scene/stage.ts';
import { Tools } from './scene/tools.ts';
import { keepDrafts, restoreDraft } from './state/drafts.ts';

/** `?aa=0` turns antialiasing off and `?dpr=1` fixes the pixel ratio: both for slow renderers. */
const query = new URLSearchParams(location.search);
const ratio = Number(query.get('dpr'));

const scene = document.createElement('div');
scene.className = 'scene';
const canvas = document.createElement('canvas');
canvas.tabIndex = 0;
canvas.setAttribute('role', 'application');
scene.append(canvas);
current.subscribe((now) => {
  canvas.setAttribute('aria-label', now?.room.sceneLabel ?? 'Scene');
});

const root = document.getElementById('app');
if (root === null) throw new Error('The page has no #app.');

/** Null without WebGL 2. */
function makeStage(): Stage | null {
  try {
    return new Stage(scene, canvas, {
      antialias: query.get('aa') !== '0',
      ...(ratio > 0 && { pixelRatio: ratio }),
    });
  } catch (error) {
    console.warn(error);
    return null;
  }
}

const stage = makeStage();
if (stage === null) {
  const message = document.createElement('p');
  message.className = 'fatal';
  message.textContent = 'soapfilm could not start. It needs a browser with WebGL 2.';
  root.append(message);
} else {
  const room = () => current.peek()?.room;
  const tools = new Tools(stage, () => room()?.pen ?? null, () => room()?.pressed?.());
  const actions = computed(() => actionsOf(stage, tools, current.value?.room));
  render(<App modes={kModes} stage={stage} scene={scene} actions={() => actions.value} />, root);
  attachKeyboard({ canvas, actions: () => actions.peek(), isBusy: () => tools.isBusy });
  await restoreDraft();
  await startRooms({ modes: kModes, stage, leave: () => void tools.cancel() });
  keepDrafts();
}
