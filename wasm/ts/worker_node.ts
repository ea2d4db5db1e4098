// The entry `soapfilm/worker` in Node.
import './node_host.js';
export * from './worker.js';
