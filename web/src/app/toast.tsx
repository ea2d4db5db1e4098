// A passing remark over the scene.
import { dismissNotice, notice } from '../state/notice.ts';
import { Icon } from './icons.tsx';

export function Toast() {
  const now = notice.value;
  const { action } = now ?? {};
  return (
    <div class="toast-place" aria-live="polite">
      {now && (
        <div class={`toast floating ${now.kind}`}>
          <span>{now.text}</span>
          {action && (
            <button
              type="button"
              class="button small"
              onClick={() => {
                dismissNotice();
                action.run();
              }}
            >
              {action.label}
            </button>
          )}
          <button type="button" class="icon-button small" aria-label="Dismiss" onClick={dismissNotice}>
            <Icon name="close" />
          </button>
        </div>
      )}
    </div>
  );
}
