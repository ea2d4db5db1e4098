// The script of a Web Worker. The build makes it self-contained.
import { serve, type Port } from './serve.js';

serve(self as unknown as Port);
