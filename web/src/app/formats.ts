// What reads and writes files, by itself, so that the page need not fetch it before it is wanted.
export { formatLoops, formatObj, parseLoops } from 'soapfilm';
