// The table of fields, as the JSON Schema that the library makes of it.

export interface Schema {
  type?: string;
  description?: string;
  unit?: string;
  default?: unknown;
  enum?: (string | number)[];
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  items?: Schema;
  minItems?: number;
  maxItems?: number;
  properties?: Record<string, Schema>;
  additionalProperties?: boolean | Schema;
  oneOf?: Schema[];
  $ref?: string;
  $defs?: Record<string, Schema>;
}

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

// Whole numbers that a double does not hold, as seeds may be, are texts of their digits here.
export const read = (text: string): Json =>
  JSON.parse(text.replace(/"(?:[^"\\]|\\.)*"|-?\d[\d.eE+-]*/g, (token) => (/^\d{16,}$/.test(token) ? `"${token}"` : token))) as Json;
export const written = (json: Json): string => JSON.stringify(json).replace(/"(\d{16,})"/g, "$1");

export const isObject = (json: Json | undefined): json is { [key: string]: Json } =>
  typeof json === "object" && json !== null && !Array.isArray(json);

export function resolved(schema: Schema, root: Schema): Schema {
  const name = schema.$ref?.replace("#/$defs/", "");
  const target = name === undefined ? undefined : root.$defs?.[name];
  if (!target) return schema;
  const { $ref: _, ...rest } = schema;
  return { ...resolved(target, root), ...rest };
}

export const typeName = (alternative: Schema): string => String(alternative.properties?.type?.enum?.[0] ?? "");

// "optical_depth" for people.
export const labelOf = (key: string): string => {
  const words = key.replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
};

// Help, unit, range and default in a line.
export function aboutOf({ description = "", minimum, exclusiveMinimum, maximum, default: standard }: Schema): string {
  const range = [
    ...(minimum === undefined ? [] : [`at least ${minimum}`]), ...(exclusiveMinimum === undefined ? [] : [`more than ${exclusiveMinimum}`]),
    ...(maximum === undefined ? [] : [`at most ${maximum}`]),
  ];
  const words = standard === undefined || standard === "" ? [] : [`default ${typeof standard === "object" ? JSON.stringify(standard) : String(standard)}`];
  return [description, ...range, ...words].join("; ");
}

// Where a slider goes from and to: the allowed range where that is of a size to slide over, otherwise around the default and the value.
export interface Slide {
  low: number;
  high: number;
  logarithmic: boolean;
}
export function slideOf(schema: Schema, value: number, fallback: number): Slide {
  const low = schema.minimum ?? schema.exclusiveMinimum ?? -Infinity;
  const high = schema.maximum ?? Infinity;
  const standard = typeof schema.default === "number" ? schema.default : fallback;
  if (Number.isFinite(low) && high - low <= 1000) return { low, high, logarithmic: low > 0 && high / low > 30 };
  const positive = low > 0 || schema.exclusiveMinimum === 0;
  if (positive) {
    const middle = standard > 0 ? standard : 1;
    return {
      low: Math.max(Math.min(middle / 16, value / 2), low > 0 ? low : 0),
      high: Math.min(Math.max(middle * 16, value * 2), high),
      logarithmic: true,
    };
  }
  const reach = Math.max(2, 3 * Math.abs(standard), 1.5 * Math.abs(value));
  if (low >= 0) return { low, high: Math.min(reach, high), logarithmic: false };
  return { low: Math.max(-reach, low), high: Math.min(reach, high), logarithmic: false };
}

export const toSlider = ({ low, high, logarithmic }: Slide, value: number): number =>
  Math.min(1, Math.max(0, logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low)));
export const fromSlider = ({ low, high, logarithmic }: Slide, t: number): number =>
  logarithmic ? low * (high / low) ** t : low + (high - low) * t;

// A number as short as a slider's step allows.
export const rounded = (value: number, slide: Slide): number => {
  if (value === 0) return 0;
  const scale = slide.logarithmic ? Math.abs(value) / 200 : (slide.high - slide.low) / 1000;
  const digits = Math.max(0, Math.ceil(-Math.log10(scale)));
  return Number(value.toFixed(Math.min(digits, 12)));
};
