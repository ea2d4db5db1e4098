// Models as JSON.
import { fieldsOf, guarded, mustBe, show } from './check.js';
import { SoapfilmError } from './errors.js';
import type { Model } from './surface_types.js';

const kSchema = 'trimmed-nurbs/1';

/** What JSON says. @throws SoapfilmError `bad-file` */
export function parsedJson(json: unknown): unknown {
  if (typeof json !== 'string') return json;
  try {
    return JSON.parse(json) as unknown;
  } catch (cause) {
    throw new SoapfilmError('bad-file', `The file is not JSON: ${String(cause)}`, undefined, { cause });
  }
}

/**
 * Reads a model of the schema `trimmed-nurbs/1`. What is in its faces and edges is looked at by `TrimmedModel`.
 * @param json text, or what it says
 * @throws SoapfilmError `bad-file` if it is no such model
 */
export function parseTrimmedModel(json: unknown): Model {
  const model = parsedJson(json);
  const names = { schema: true, faces: true, edges: true, instances: true } as const;
  const { schema, ...lists } = fieldsOf<Record<keyof typeof names, unknown>>(model, names, 'model', 'bad-file');
  if (schema !== kSchema) throw new SoapfilmError('bad-file', `The model's \`schema\` must be '${kSchema}', not ${show(schema)}`);
  if (lists.instances === undefined) {
    for (const name of ['faces', 'edges'] as const) {
      const list = lists[name];
      if (!guarded('bad-file', `model.${name}`, () => Array.isArray(list))) throw mustBe('bad-file', `model.${name}`, 'an array', list);
    }
  }
  return model as Model;
}
