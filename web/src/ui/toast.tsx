// A passing remark over the scene.
import { dismissNotice, notice } from '../state/store.ts';
import { Icon } from './icons.tsx';

export function Toast() {
  const current = notice.value;
  return (
    <div class="toast-place" aria-live="polite">
      {current && (
        <div class={`toast floating ${current.kind}`}>
          <span>{current.text}</span>
          <button type="button" class="icon-button small" aria-label="Dismiss" onClick={dismissNotice}>
            <Icon name="close" />
          </button>
        </div>
      )}
    </div>
  );
}
