// Models from files. What reads them is fetched with the first file.
import { SoapfilmError } from 'soapfilm';
import type { Content } from '../../app/content.ts';
import type { ReadFile } from '../../app/mode.ts';
import { newItem } from '../../state/document.ts';
import { modelKind } from './model_kind.ts';

/** @throws SoapfilmError `bad-file` */
export async function readModel(_: string, content: Content): Promise<ReadFile> {
  const { parseTrimmedModel } = await import('soapfilm/surfaces');
  try {
    const model = parseTrimmedModel(content.text);
    return { items: [newItem(modelKind, { model })], ...(model.name !== undefined && { name: model.name }) };
  } catch (error) {
    if (error instanceof SoapfilmError && error.code !== 'bad-file') throw new SoapfilmError('bad-file', error.message, undefined, { cause: error });
    throw error;
  }
}
