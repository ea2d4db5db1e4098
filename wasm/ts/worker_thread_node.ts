// The script of a Node worker thread. The build makes it self-contained.
import { parentPort } from 'node:worker_threads';
import { serve, type Port } from './serve.js';

serve(parentPort as unknown as Port);
