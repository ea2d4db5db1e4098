// What the materials of surfaces share: pieces of their shaders, colours as uniforms, how they are drawn.
import { Color, DoubleSide, ShaderMaterial, type IUniform } from 'three';

/** For vertices of which three in a row are a triangle: which corner one is, as a weight of 1 among three. */
export const kCorner = /* glsl */ `
vec3 cornerOf(int vertex) {
  int corner = vertex % 3;
  return vec3(float(corner == 0), float(corner == 1), float(corner == 2));
}`;

/** Edges of triangles, 0.75 pixels wide; those of triangles lower than a few pixels fade, else they would cover all. */
export const kWire = /* glsl */ `
float wireAt(vec3 corner, float fadeFrom, float fadeTo) {
  vec3 perPixel = fwidth(corner);
  // Half of an edge.
  vec3 inside = smoothstep(perPixel * -0.125, perPixel * 0.875, corner);
  vec3 strength = (1.0 - inside) * (1.0 - smoothstep(fadeFrom, fadeTo, perPixel));
  return max(max(strength.x, strength.y), strength.z);
}`;

/** Light from over the viewer's left shoulder, and from the sky. */
export const kLight = /* glsl */ `
const vec3 kKey = vec3(-0.4262, 0.6156, 0.6629);
const vec3 kSky = vec3(0.8664, -0.1083, 0.4874);
/** shares: of light from everywhere, over the shoulder, the sky */
float lightOn(vec3 normal, vec3 shares) {
  return dot(shares, vec3(1.0, clamp(dot(normal, kKey), 0.0, 1.0), clamp(dot(normal, kSky), 0.0, 1.0)));
}
float glossOn(vec3 normal, vec3 toEye) {
  return pow(clamp(dot(normal, normalize(kKey + toEye)), 0.0, 1.0), 32.0);
}`;

export const colorUniforms = <Name extends string>(...names: readonly Name[]) =>
  Object.fromEntries(names.map((name) => [name, { value: new Color() }])) as Record<Name, { value: Color }>;

export function setColors({ uniforms }: ShaderMaterial, colors: Readonly<Record<string, Color | string>>): void {
  for (const [name, color] of Object.entries(colors)) (uniforms[name].value as Color).set(color);
}

/** @param away how far it is pushed back, so that lines and dots lie on it unbroken: at one place, less is before more */
export function surfaceMaterial(vertexShader: string, fragmentShader: string, away: number, uniforms: Record<string, IUniform>): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    uniforms,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: away,
  });
}
