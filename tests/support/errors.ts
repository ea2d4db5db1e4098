import { SoapfilmError } from 'soapfilm';

/** The SoapfilmError that a call throws or a promise is rejected with; other errors pass. */
export function errorOf(call: () => unknown): SoapfilmError {
  try {
    call();
  } catch (error) {
    return asSoapfilmError(error);
  }
  throw new Error('nothing was thrown');
}

export async function rejectionOf(promise: Promise<unknown>): Promise<SoapfilmError> {
  try {
    await promise;
  } catch (error) {
    return asSoapfilmError(error);
  }
  throw new Error('the promise was not rejected');
}

function asSoapfilmError(error: unknown): SoapfilmError {
  if (error instanceof SoapfilmError) return error;
  throw error;
}
