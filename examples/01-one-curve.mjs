// The shortest program: a closed curve in, triangles out.
import { load, spanLoops } from 'soapfilm';

await load();

// A monkey saddle's rim: 24 points on the unit circle that rise and fall three times.
const curve = Array.from({ length: 24 }, (_, i) => {
  const angle = (2 * Math.PI * i) / 24;
  return [Math.cos(angle), Math.sin(angle), 0.5 * Math.cos(3 * angle)];
});

const span = spanLoops([curve]);
if (!span.found) throw new Error(span.reason);

console.log(`${span.triangles.length / 3} triangles on ${span.positions.length / 3} vertices`);
console.log(`area ${span.terms.area.toFixed(4)}, bending ${span.terms.dihedral.toFixed(4)} rad`);
console.log(`proven to be the best: ${span.optimal}`);
