// The numbers of PLY after its header, one after the other, from text or from bytes.
import { ByteScanner } from './byte_scanner.js';
import type { ErrorPlace } from './errors.js';
import { badFile } from './mesh_file.js';
import { kSizes, type Element, type PlyHeader, type Scalar } from './ply_header.js';

export interface Source {
  /** Goes to the next element. */
  begin(): void;
  next(type: Scalar): number;
  /** That there are no more numbers in the element. */
  end(): void;
  /** Of the element, for errors. */
  readonly place: ErrorPlace;
  /** How many elements there may be at most in what is left. */
  roomFor(element: Element): number;
}

export const plySource = (bytes: Uint8Array, { format, length, lines }: PlyHeader): Source =>
  format === 'ascii' ? new TextSource(bytes, length, lines + 1) : new BinarySource(bytes, length, format === 'little');

const kTooShort = 'the file ends too early';

/** Each element is a line. */
class TextSource implements Source {
  private readonly scan: ByteScanner;

  constructor(
    private readonly bytes: Uint8Array,
    from: number,
    line: number,
  ) {
    this.scan = new ByteScanner(bytes, false, from, line);
  }

  begin(): void {
    while (!this.scan.toWord()) if (!this.scan.nextLine()) throw badFile(kTooShort, this.place);
  }

  next(): number {
    const { scan } = this;
    if (scan.toWord()) return scan.value('the element');
    throw badFile(scan.isAtEnd ? kTooShort : 'there are fewer numbers than the header and the lists in this line say', this.place);
  }

  end(): void {
    if (this.scan.toWord()) throw badFile('there are more numbers than the header and the lists in this line say', this.place);
  }

  get place(): ErrorPlace {
    return { line: this.scan.line };
  }

  /** A digit and a blank for each number. */
  roomFor({ properties }: Element): number {
    return Math.ceil((this.bytes.length + 1 - this.scan.at) / (2 * Math.max(1, properties.length)));
  }
}

class BinarySource implements Source {
  readonly place = {};
  private readonly view: DataView;

  constructor(
    bytes: Uint8Array,
    private at: number,
    private readonly isLittle: boolean,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  begin(): void {
    // Nothing lies between elements.
  }

  next(type: Scalar): number {
    const { view, at, isLittle } = this;
    this.at += kSizes[type];
    if (this.at > view.byteLength) throw badFile(kTooShort);
    switch (type) {
      case 'int8':
        return view.getInt8(at);
      case 'uint8':
        return view.getUint8(at);
      case 'int16':
        return view.getInt16(at, isLittle);
      case 'uint16':
        return view.getUint16(at, isLittle);
      case 'int32':
        return view.getInt32(at, isLittle);
      case 'uint32':
        return view.getUint32(at, isLittle);
      case 'float32':
        return view.getFloat32(at, isLittle);
      case 'float64':
        return view.getFloat64(at, isLittle);
    }
  }

  end(): void {
    // Nothing tells where an element should have ended.
  }

  roomFor({ properties }: Element): number {
    const least = properties.reduce((sum, { type, countType }) => sum + kSizes[countType ?? type], 0);
    return least === 0 ? Infinity : Math.floor((this.view.byteLength - this.at) / least);
  }
}
