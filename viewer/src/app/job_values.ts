/** Parameters of an estimator as the user enters them. */
import type { JobParameter, ParameterValue } from '../core/protocol';

export type Entered = string | boolean;

const NUMBER = /^(int(eger)?\d*|double|float\d*|number)$/i;
export const isFlag = (parameter: JobParameter): boolean => /^bool/i.test(parameter.type);
export const isNumber = (parameter: JobParameter): boolean => NUMBER.test(parameter.type);
const isNumberList = (parameter: JobParameter): boolean => /^numbers$/i.test(parameter.type);

/** Value as it is entered: lists and objects as JSON. */
export function enteredOf(parameter: JobParameter): Entered {
  const value = parameter.default;
  if (isFlag(parameter)) return value === true;
  if (value === null || value === undefined) return '';
  if (isNumberList(parameter) && Array.isArray(value)) return value.join(', ');
  return typeof value === 'object' ? JSON.stringify(value) : String(value);
}

/** Value of an entry; `undefined` if it is not valid for the parameter. */
export function valueOf(parameter: JobParameter, entered: Entered): ParameterValue | undefined {
  if (typeof entered === 'boolean') return entered;
  const text = entered.trim();
  if (isNumber(parameter)) {
    const value = Number(text);
    if (text === '' || !Number.isFinite(value)) return undefined;
    if (/int/i.test(parameter.type) && !Number.isInteger(value)) return undefined;
    if (parameter.min !== null && parameter.min !== undefined && value < parameter.min) {
      return undefined;
    }
    if (parameter.max !== null && parameter.max !== undefined && value > parameter.max) {
      return undefined;
    }
    return value;
  }
  if (isNumberList(parameter)) {
    const all = text
      .split(/[\s,]+/)
      .filter(Boolean)
      .map(Number);
    return all.every(Number.isFinite) ? all : undefined;
  }
  if (typeof parameter.default === 'object' && parameter.default !== null) {
    try {
      return JSON.parse(text) as ParameterValue;
    } catch {
      return undefined;
    }
  }
  return entered;
}

/** Values that differ from their defaults, and the names of entries that are not valid. */
export function changedValues(
  parameters: readonly JobParameter[],
  entered: Readonly<Record<string, Entered>>,
): { values: Record<string, ParameterValue>; invalid: string[] } {
  const values: Record<string, ParameterValue> = {};
  const invalid: string[] = [];
  for (const parameter of parameters) {
    const text = entered[parameter.name];
    if (text === undefined || text === enteredOf(parameter)) continue;
    const value = valueOf(parameter, text);
    if (value === undefined) invalid.push(parameter.name);
    else if (JSON.stringify(value) !== JSON.stringify(parameter.default)) {
      values[parameter.name] = value;
    }
  }
  return { values, invalid };
}
