// Icons: strokes on a 24-unit square, in the colour of the text around them.
const kPaths = {
  select: 'M6 3l5 16 2.4-6.6L20 10z',
  draw: 'M4 20c1-4 2-5 3-6L17 4l3 3L10 17c-1 1-2 2-6 3zM14.5 6.5l3 3',
  gallery: 'M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z',
  open: 'M3 18V6a1 1 0 0 1 1-1h5l2 2.5h8a1 1 0 0 1 1 1V10M3 18l2.4-7a1 1 0 0 1 1-.7H21a.7.7 0 0 1 .7 1L19.5 18a1 1 0 0 1-1 .7H3.7',
  save: 'M12 4v11M7.5 10.8L12 15.3l4.5-4.5M4 16.5V19a1 1 0 0 0 1 1h14a1 1 0 0 0 1-1v-2.5',
  undo: 'M8.5 5L4 9.5 8.5 14M4.5 9.5H14a5.25 5.25 0 0 1 0 10.5h-3',
  redo: 'M15.5 5L20 9.5 15.5 14M19.5 9.5H10a5.25 5.25 0 0 0 0 10.5h3',
  trash: 'M4 6.5h16M9 6.5V4.5h6v2M6.5 6.5l.8 12.5a1 1 0 0 0 1 1h7.4a1 1 0 0 0 1-1l.8-12.5M10 10.5v6M14 10.5v6',
  clear: 'M12 3.5a8.5 8.5 0 1 0 0 17 8.5 8.5 0 0 0 0-17zM9 9l6 6M15 9l-6 6',
  help: 'M9 9.2a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.2-1.5 2.4M12 17.5v.01M12 3.5a8.5 8.5 0 1 0 0 17 8.5 8.5 0 0 0 0-17z',
  play: 'M7 4.5v15l12-7.5z',
  skip: 'M5 5v14l9-7zM18 5v14',
  fit: 'M4 9V5a1 1 0 0 1 1-1h4M15 4h4a1 1 0 0 1 1 1v4M20 15v4a1 1 0 0 1-1 1h-4M9 20H5a1 1 0 0 1-1-1v-4M12 9.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z',
  face: 'M4 8l8-4 8 4-8 4zM12 20v-4.5M9.5 17.5L12 20l2.5-2.5',
  circle: 'M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16z',
  close: 'M6 6l12 12M18 6L6 18',
  chevron: 'M6 14.5L12 9l6 5.5',
  check: 'M5 12.5l4.5 4.5L19 7.5',
} as const;

export type IconName = keyof typeof kPaths;
/** One of these, or one of a mode's own by its path. */
export type AnyIcon = IconName | { readonly path: string };

export function Icon({ name: icon }: { name: AnyIcon }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true">
      <path d={typeof icon === 'string' ? kPaths[icon] : icon.path} />
    </svg>
  );
}

/** Two rings and the film between them. */
export function Logo() {
  return (
    <svg class="logo" viewBox="0 0 24 24" aria-hidden="true">
      <path class="logo-film" d="M3.5 5c4.5 4.5 4.5 9.5 0 14 3 3.3 14 3.3 17 0-4.5-4.5-4.5-9.5 0-14-3 3.3-14 3.3-17 0z" />
      <ellipse cx="12" cy="5" rx="8.5" ry="2.7" />
      <ellipse cx="12" cy="19" rx="8.5" ry="2.7" />
      <path d="M3.5 5c4.5 4.5 4.5 9.5 0 14M20.5 5c-4.5 4.5-4.5 9.5 0 14" />
    </svg>
  );
}
