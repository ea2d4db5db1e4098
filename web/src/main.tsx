// Puts the page together: the scene, the panels, the keys, and the first example.
import { render } from 'preact';
import { attachPointer } from './scene/pointer.ts';
import { Stage } from './scene/stage.ts';
import { openExample } from './state/files.ts';
import { kGallery } from './state/gallery.ts';
import { followDocument } from './state/solving.ts';
import { forgetHistory } from './state/store.ts';
import { exposeForInspection } from './inspection.ts';
import { actOn } from './ui/actions.ts';
import { App } from './ui/app.tsx';
import { attachKeys } from './ui/keys.ts';
import { followMode } from './ui/modes.tsx';

/** `?aa=0` turns antialiasing off and `?dpr=1` fixes the pixel ratio: both for slow renderers. */
const query = new URLSearchParams(location.search);
const ratio = Number(query.get('dpr'));

const scene = document.createElement('div');
scene.className = 'scene';
const canvas = document.createElement('canvas');
canvas.tabIndex = 0;
canvas.setAttribute('role', 'application');
canvas.setAttribute('aria-label', 'Scene: curves and surface. Arrows turn the view; comma and full stop choose a vertex.');
scene.append(canvas);

const root = document.getElementById('app');
if (root === null) throw new Error('The page has no #app.');

try {
  const stage = new Stage(scene, canvas, {
    antialias: query.get('aa') !== '0',
    ...(ratio > 0 && { pixelRatio: ratio }),
  });
  actOn(stage);
  render(<App stage={stage} scene={scene} />, root);
  attachKeys(stage, attachPointer(stage));
  exposeForInspection(stage);
  openExample(kGallery[0], kGallery[0].variants?.values[0], true);
  forgetHistory();
  followDocument();
  followMode();
} catch (error) {
  root.innerHTML = '';
  const message = document.createElement('p');
  message.className = 'fatal';
  message.textContent = `soapfilm could not start. It needs a browser with WebGL 2. (${String(error)})`;
  root.append(message);
}
