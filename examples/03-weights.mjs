// What "best" means: the same curve with the least area, the least bending, and the least worst fold.
import { load, spanLoops } from 'soapfilm';

await load();

const curve = Array.from({ length: 30 }, (_, i) => {
  const angle = (2 * Math.PI * i) / 30;
  return [2 * Math.cos(angle), Math.sin(angle), 0.8 * Math.sin(2 * angle)];
});

const settings = {
  'least area': { weights: { area: 1 } },
  'least bending': { weights: { dihedral: 1 } },
  'a mix': { weights: { area: 1, dihedral: 0.2 } },
  'least worst fold': { weights: { dihedral: 1 }, objective: 'worst-dihedral' },
};

console.log('                    area   bending  worst fold');
for (const [name, options] of Object.entries(settings)) {
  const span = spanLoops([curve], { candidates: 'all', ...options });
  if (!span.found) throw new Error(span.reason);
  const { area, dihedral, worstDihedral } = span.terms;
  const columns = [area, dihedral, worstDihedral].map((value) => value.toFixed(4).padStart(9));
  console.log(`${name.padEnd(16)}${columns.join(' ')}`);
}
