/**
 * Arithmetic over the fields of topics, as text: `deg(/odom:pose.pose.orientation.yaw)`. The parser is small and
 * evaluates nothing but the functions below, so that a text from a file or a link cannot run code.
 *
 * A `/` where a value is expected begins a topic, otherwise it divides: names of topics need no quotes.
 */

import { t } from '../texts/language.svelte';

/** Field of a topic. */
export interface FieldRef {
  topic: string;
  path: string;
}

/** Values over time, sorted by time. */
export interface Samples {
  times: ArrayLike<number>;
  values: ArrayLike<number>;
}

export type Expression =
  | { kind: 'number'; value: number }
  | { kind: 'time' }
  | { kind: 'field'; ref: FieldRef }
  | { kind: 'negative'; arg: Expression }
  | { kind: 'binary'; operator: Operator; left: Expression; right: Expression }
  | { kind: 'call'; name: string; args: Expression[] };

export type Operator =
  '+' | '-' | '*' | '/' | '%' | '^' | '<' | '>' | '<=' | '>=' | '==' | '!=' | '&&' | '||';

/** Error with its position in the text, counted from 0. */
export class ExpressionError extends Error {
  constructor(
    message: string,
    readonly at: number,
  ) {
    super(message);
  }
}

const MAX_LENGTH = 2000;
const MAX_DEPTH = 60;

const DEG_PER_RAD = 180 / Math.PI;

/** Functions of numbers: they are applied at each time. */
const POINTWISE: Record<string, { arity: [number, number]; of: (...args: number[]) => number }> = {
  sqrt: { arity: [1, 1], of: Math.sqrt },
  abs: { arity: [1, 1], of: Math.abs },
  sign: { arity: [1, 1], of: Math.sign },
  floor: { arity: [1, 1], of: Math.floor },
  ceil: { arity: [1, 1], of: Math.ceil },
  round: { arity: [1, 1], of: Math.round },
  exp: { arity: [1, 1], of: Math.exp },
  log: { arity: [1, 1], of: Math.log },
  log10: { arity: [1, 1], of: Math.log10 },
  sin: { arity: [1, 1], of: Math.sin },
  cos: { arity: [1, 1], of: Math.cos },
  tan: { arity: [1, 1], of: Math.tan },
  asin: { arity: [1, 1], of: Math.asin },
  acos: { arity: [1, 1], of: Math.acos },
  atan: { arity: [1, 1], of: Math.atan },
  atan2: { arity: [2, 2], of: Math.atan2 },
  hypot: { arity: [1, 8], of: Math.hypot },
  min: { arity: [1, 8], of: Math.min },
  max: { arity: [1, 8], of: Math.max },
  clamp: { arity: [3, 3], of: (x, low, high) => Math.min(Math.max(x, low), high) },
  deg: { arity: [1, 1], of: (x) => x * DEG_PER_RAD },
  rad: { arity: [1, 1], of: (x) => x / DEG_PER_RAD },
  wrap: { arity: [1, 1], of: (x) => Math.atan2(Math.sin(x), Math.cos(x)) },
  if: { arity: [3, 3], of: (test, yes, no) => (test ? yes : no) },
};

type Column = Float64Array;

/** Functions of a whole series. */
const OVER_TIME: Record<
  string,
  { arity: [number, number]; of: (times: Column, args: Column[]) => Column }
> = {
  derivative: { arity: [1, 1], of: (times, [x]) => derivative(times, x!) },
  integral: { arity: [1, 1], of: (times, [x]) => integral(times, x!) },
  average: { arity: [2, 2], of: (times, [x, windowS]) => average(times, x!, windowS![0] ?? 0) },
  unwrap: { arity: [1, 1], of: (_times, [x]) => unwrap(x!) },
  delta: { arity: [1, 1], of: (_times, [x]) => x!.map((v, i) => (i > 0 ? v - x![i - 1]! : NaN)) },
};

/** Names of all functions, sorted. */
export const FUNCTIONS: readonly string[] = [
  ...Object.keys(POINTWISE),
  ...Object.keys(OVER_TIME),
].sort();

const CONSTANTS: Record<string, number> = { pi: Math.PI };

// Parser.

interface Token {
  kind: 'number' | 'name' | 'topic' | 'symbol' | 'end';
  text: string;
  at: number;
}

const SPACE = /\s+/y;
const NUMBER = /(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?/y;
const PATH = /[A-Za-z_]\w*(\[\d+\])*(\.[A-Za-z_]\w*(\[\d+\])*)*/y;
const TOPIC = /(\/[A-Za-z_~]\w*)+[:.][A-Za-z_]\w*(\[\d+\])*(\.[A-Za-z_]\w*(\[\d+\])*)*/y;
const SYMBOL = /<=|>=|==|!=|&&|\|\||[-+*/%^<>(),]/y;

/** Precedence of the operators; those of a row bind equally. */
const ROWS: readonly Operator[][] = [
  ['||'],
  ['&&'],
  ['==', '!='],
  ['<', '>', '<=', '>='],
  ['+', '-'],
  ['*', '/', '%'],
];

class Parser {
  private at = 0;
  private token: Token;
  private depth = 0;

  constructor(
    private text: string,
    private base: FieldRef | undefined,
  ) {
    if (text.length > MAX_LENGTH) {
      throw new ExpressionError(t().expression.tooLong(MAX_LENGTH), MAX_LENGTH);
    }
    this.token = this.next(true);
  }

  parse(): Expression {
    const found = this.row(0);
    if (this.token.kind !== 'end') this.fail(t().expression.unexpected(this.token.text));
    return found;
  }

  private fail(message: string, at = this.token.at): never {
    throw new ExpressionError(message, at);
  }

  private match(pattern: RegExp): string | undefined {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text)?.[0];
    if (found) this.at += found.length;
    return found;
  }

  /** Next token; `isValue`: a value is expected, so that `/` begins a topic. */
  private next(isValue: boolean): Token {
    this.match(SPACE);
    const at = this.at;
    if (at >= this.text.length) return { kind: 'end', text: '', at };
    const kinds: [Token['kind'], RegExp][] = [
      ['number', NUMBER],
      ['name', PATH],
      ['symbol', SYMBOL],
    ];
    if (isValue) kinds.unshift(['topic', TOPIC]);
    for (const [kind, pattern] of kinds) {
      const text = this.match(pattern);
      if (text) return { kind, text, at };
    }
    return this.fail(t().expression.unexpected(this.text[at]!), at);
  }

  private take(isValue: boolean): Token {
    const taken = this.token;
    this.token = this.next(isValue);
    return taken;
  }

  private row(level: number): Expression {
    const operators = ROWS[level];
    if (!operators) return this.unary();
    if (level === 0 && ++this.depth > MAX_DEPTH) this.fail(t().expression.tooDeep);
    let left = this.row(level + 1);
    while (this.token.kind === 'symbol' && operators.includes(this.token.text as Operator)) {
      const operator = this.take(true).text as Operator;
      left = { kind: 'binary', operator, left, right: this.row(level + 1) };
    }
    if (level === 0) this.depth--;
    return left;
  }

  private unary(): Expression {
    let isNegative = false;
    while (this.token.text === '-' || this.token.text === '+') {
      isNegative = isNegative !== (this.take(true).text === '-');
    }
    const found = this.power();
    return isNegative ? { kind: 'negative', arg: found } : found;
  }

  /** A power binds to the right and more strongly than a sign before it: -x^2 is -(x^2). */
  private power(): Expression {
    const left = this.value();
    if (this.token.text !== '^') return left;
    this.take(true);
    if (++this.depth > MAX_DEPTH) this.fail(t().expression.tooDeep);
    const right = this.unary();
    this.depth--;
    return { kind: 'binary', operator: '^', left, right };
  }

  private value(): Expression {
    const { kind, text, at } = this.token;
    if (kind === 'number') {
      this.take(false);
      return { kind: 'number', value: Number(text) };
    }
    if (kind === 'topic') {
      this.take(false);
      const end = text.search(/[:.]/);
      return { kind: 'field', ref: { topic: text.slice(0, end), path: text.slice(end + 1) } };
    }
    if (kind === 'name') {
      this.take(false);
      if (this.token.text === '(') return this.call(text, at);
      return this.name(text, at);
    }
    if (text === '(') {
      this.take(true);
      const inner = this.row(0);
      this.close();
      return inner;
    }
    return this.fail(text === '/' ? t().expression.topicForm : t().expression.missingValue(text));
  }

  private name(text: string, at: number): Expression {
    if (text in CONSTANTS) return { kind: 'number', value: CONSTANTS[text]! };
    if (text === 'time') return { kind: 'time' };
    if (!this.base) {
      return this.fail(t().expression.noTopic(text), at);
    }
    const { topic, path } = this.base;
    return { kind: 'field', ref: { topic, path: path ? `${path}.${text}` : text } };
  }

  private close(): void {
    if (this.token.text !== ')') this.fail(t().expression.missingBracket(this.token.text));
    this.take(false);
  }

  private call(name: string, at: number): Expression {
    const known = POINTWISE[name] ?? OVER_TIME[name];
    if (!known || !FUNCTIONS.includes(name)) {
      this.fail(t().expression.noFunction(name, FUNCTIONS.join(', ')), at);
    }
    this.take(true);
    const args = [this.row(0)];
    while (this.token.text === ',') {
      this.take(true);
      args.push(this.row(0));
    }
    this.close();
    const [min, max] = known.arity;
    if (args.length < min || args.length > max) {
      const wanted = min === max ? `${min}` : `${min}–${max}`;
      this.fail(t().expression.arity(name, wanted, args.length), at);
    }
    return { kind: 'call', name, args };
  }
}

/** Parses a text; names without a topic are fields below `base`. Throws an `ExpressionError`. */
export function parseExpression(text: string, base?: FieldRef): Expression {
  return new Parser(text, base).parse();
}

/** Text of a field in an expression. */
export const refText = ({ topic, path }: FieldRef): string => `${topic}:${path}`;

/** All fields of an expression, each once, in their order. */
export function fieldsOf(expression: Expression): FieldRef[] {
  const found = new Map<string, FieldRef>();
  const visit = (node: Expression): void => {
    if (node.kind === 'field') found.set(refText(node.ref), node.ref);
    else if (node.kind === 'negative') visit(node.arg);
    else if (node.kind === 'binary') [node.left, node.right].forEach(visit);
    else if (node.kind === 'call') node.args.forEach(visit);
  };
  visit(expression);
  return [...found.values()];
}

// Evaluation.

/**
 * Values of an expression at the times of its first field. Other fields have there the value of their last message
 * before: nothing is invented between messages.
 */
export function evaluate(
  expression: Expression,
  samplesOf: (ref: FieldRef) => Samples,
): { times: Column; values: Column } {
  const first = fieldsOf(expression)[0];
  const times = Float64Array.from(first ? samplesOf(first).times : []);
  return { times, values: column(expression, times, samplesOf) };
}

function column(node: Expression, times: Column, samplesOf: (ref: FieldRef) => Samples): Column {
  switch (node.kind) {
    case 'number':
      return new Float64Array(times.length).fill(node.value);
    case 'time':
      return times;
    case 'field':
      return held(samplesOf(node.ref), times);
    case 'negative':
      return column(node.arg, times, samplesOf).map((v) => -v);
    case 'binary': {
      const left = column(node.left, times, samplesOf);
      const right = column(node.right, times, samplesOf);
      return left.map((v, i) => operate(node.operator, v, right[i]!));
    }
    case 'call': {
      const args = node.args.map((arg) => column(arg, times, samplesOf));
      const series = OVER_TIME[node.name];
      if (series) return series.of(times, args);
      const { of } = POINTWISE[node.name]!;
      return times.map((_, i) => of(...args.map((arg) => arg[i]!)));
    }
  }
}

function operate(operator: Operator, a: number, b: number): number {
  switch (operator) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    case '%':
      return a % b;
    case '^':
      return a ** b;
    case '<':
      return Number(a < b);
    case '>':
      return Number(a > b);
    case '<=':
      return Number(a <= b);
    case '>=':
      return Number(a >= b);
    case '==':
      return Number(a === b);
    case '!=':
      return Number(a !== b);
    case '&&':
      return Number(a !== 0 && b !== 0);
    case '||':
      return Number(a !== 0 || b !== 0);
  }
}

/** Last value at or before each time; NaN before the first one. */
function held({ times: from, values }: Samples, times: Column): Column {
  const out = new Float64Array(times.length);
  let j = -1;
  for (let i = 0; i < times.length; i++) {
    while (j + 1 < from.length && from[j + 1]! <= times[i]!) j++;
    out[i] = j < 0 ? NaN : values[j]!;
  }
  return out;
}

/** Slope from the sample before. */
function derivative(times: Column, x: Column): Column {
  return x.map((v, i) => {
    const spanS = i > 0 ? times[i]! - times[i - 1]! : 0;
    return spanS > 0 ? (v - x[i - 1]!) / spanS : NaN;
  });
}

/** Integral by the trapezoidal rule, from 0 at the first sample. */
function integral(times: Column, x: Column): Column {
  let sum = 0;
  return x.map((v, i) => {
    const area = i > 0 ? ((v + x[i - 1]!) / 2) * (times[i]! - times[i - 1]!) : 0;
    if (Number.isFinite(area)) sum += area;
    return sum;
  });
}

/** Mean of the samples in the last `windowS` seconds, without NaN. */
function average(times: Column, x: Column, windowS: number): Column {
  let from = 0;
  let sum = 0;
  let count = 0;
  return x.map((v, i) => {
    if (Number.isFinite(v)) {
      sum += v;
      count++;
    }
    while (from < i && times[from]! <= times[i]! - windowS) {
      if (Number.isFinite(x[from]!)) {
        sum -= x[from]!;
        count--;
      }
      from++;
    }
    return count > 0 ? sum / count : NaN;
  });
}

/** Angle without jumps of a whole turn. */
function unwrap(x: Column): Column {
  let turns = 0;
  let last = NaN;
  return x.map((v) => {
    if (!Number.isNaN(last) && Number.isFinite(v)) {
      turns -= Math.round((v - last) / (2 * Math.PI));
    }
    if (Number.isFinite(v)) last = v;
    return v + turns * 2 * Math.PI;
  });
}

// Units.

/** Unit of an expression; empty where it has none or its fields do not define one. */
export function expressionUnit(
  expression: Expression,
  unitOfField: (ref: FieldRef) => string,
): string {
  const unit = unitOfNode(expression, unitOfField);
  return unit === undefined || unit.power === 0 ? '' : powerText(unit);
}

interface Unit {
  base: string;
  power: number;
}

const NONE: Unit = { base: '', power: 0 };
const SUPERSCRIPT: Record<number, string> = { 2: '²', 3: '³', 4: '⁴' };

function powerText({ base, power }: Unit): string {
  if (power === 1) return base;
  const isSimple = /^[^/·]+$/.test(base);
  const written = isSimple ? base : `(${base})`;
  return written + (SUPERSCRIPT[power] ?? `^${power}`);
}

/** `undefined`: unknown. A number has no unit and fits every sum. */
function unitOfNode(node: Expression, of: (ref: FieldRef) => string): Unit | undefined {
  const inner = (arg: Expression) => unitOfNode(arg, of);
  switch (node.kind) {
    case 'number':
      return NONE;
    case 'time':
      return { base: 's', power: 1 };
    case 'field': {
      const base = of(node.ref);
      return base ? { base, power: 1 } : undefined;
    }
    case 'negative':
      return inner(node.arg);
    case 'binary':
      return unitOfBinary(node.operator, inner(node.left), inner(node.right), node.right);
    case 'call':
      return unitOfCall(node.name, node.args, inner);
  }
}

function unitOfBinary(
  operator: Operator,
  left: Unit | undefined,
  right: Unit | undefined,
  rightNode: Expression,
): Unit | undefined {
  switch (operator) {
    case '+':
    case '-':
    case '%':
      return same([left, right]);
    case '*':
    case '/': {
      if (!left || !right) return undefined;
      const sign = operator === '*' ? 1 : -1;
      if (right.power === 0) return left;
      if (left.power === 0 && sign > 0) return right;
      if (left.base !== right.base) return undefined;
      const power = left.power + sign * right.power;
      return power === 0 ? NONE : { base: left.base, power };
    }
    case '^': {
      const exponent = rightNode.kind === 'number' ? rightNode.value : NaN;
      if (!left || Number.isNaN(exponent)) return undefined;
      return { base: left.base, power: left.power * exponent };
    }
    default:
      return NONE;
  }
}

const same = (units: (Unit | undefined)[]): Unit | undefined => {
  const known = units.filter((unit) => unit?.power !== 0);
  const [first] = known;
  if (known.length === 0) return NONE;
  return first && known.every((u) => u && u.base === first.base && u.power === first.power)
    ? first
    : undefined;
};

function unitOfCall(
  name: string,
  args: Expression[],
  inner: (arg: Expression) => Unit | undefined,
): Unit | undefined {
  const first = inner(args[0]!);
  switch (name) {
    case 'sqrt':
      return first && { base: first.base, power: first.power / 2 };
    case 'deg':
      return { base: '°', power: 1 };
    case 'rad':
    case 'asin':
    case 'acos':
    case 'atan':
    case 'atan2':
    case 'wrap':
      return { base: 'rad', power: 1 };
    case 'abs':
    case 'floor':
    case 'ceil':
    case 'round':
    case 'average':
    case 'unwrap':
    case 'delta':
    case 'clamp':
      return first;
    case 'min':
    case 'max':
    case 'hypot':
      return same(args.map(inner));
    case 'if':
      return same(args.slice(1).map(inner));
    case 'derivative':
      return first && perSecond(first);
    case 'integral':
      return first && timesSecond(first);
    default:
      return NONE;
  }
}

function perSecond({ base, power }: Unit): Unit | undefined {
  if (power !== 1) return undefined;
  if (base === 's') return NONE;
  const match = /^(.*)\/s(²?)$/.exec(base);
  if (match) return { base: `${match[1]}/s${match[2] ? '³' : '²'}`, power };
  return base.includes('/') ? undefined : { base: `${base}/s`, power };
}

function timesSecond({ base, power }: Unit): Unit | undefined {
  if (power === 0) return { base: 's', power: 1 };
  if (power !== 1) return undefined;
  const match = /^(.*)\/s(²?)$/.exec(base);
  if (match) return { base: match[2] ? `${match[1]}/s` : match[1]!, power };
  return base.includes('/') ? undefined : { base: `${base}·s`, power };
}
