// The package's entry in Node.
import './node_host.js';
export * from './index.js';
