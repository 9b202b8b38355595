import { type ComponentChildren, type JSX } from "preact";
import { useEffect, useId, useState } from "preact/hooks";
import { type Edit, edit, type Path, problem } from "../store.ts";
import {
  aboutOf, fromSlider, isObject, type Json, labelOf, resolved, rounded, type Schema, slideOf, toSlider, typeName, written,
} from "./schema.ts";
import { Choice } from "./choice.tsx";
import { RampEditor } from "./ramp.tsx";

// Controls for whatever the schema says: nothing here knows what a noise is.

export interface FieldProps {
  schema: Schema;
  root: Schema;
  value: Json | undefined;
  path: Path;
  name: string;
}

const tagOf = (path: Path): string => path.join(".");
export const set = (path: Path, value: Json): void => void edit([{ path, value: written(value) }], tagOf(path));
export const remove = (path: Path): void => void edit([{ path }], `-${tagOf(path)}`);

const isWrong = (path: Path): boolean => {
  const wrong = problem.value?.path;
  return wrong !== undefined && tagOf(wrong) === tagOf(path);
};

const whereOf = (path: Path): string => path.map((key) => (typeof key === "number" ? String(key + 1) : labelOf(key).toLowerCase())).join(" ");
// The name of a control that is deep in a recipe says where, too: there are several frequencies.
export const nameOf = (path: Path, name: string): string => (path.length > 2 ? `${labelOf(name)}, ${whereOf(path.slice(0, -1))}` : labelOf(name));

// A part that opens and closes; `tools` stand beside its title. What is closed is not made.
interface FoldProps {
  look: string; // its class
  title: string;
  open: boolean;
  tools?: ComponentChildren;
  help?: string;
  path?: Path;
  children: ComponentChildren;
}
export function Fold({ look, title, open, tools, help, path, children }: FoldProps): JSX.Element {
  const [isOpen, setOpen] = useState(open);
  useEffect(() => setOpen(open), [open]);
  return (
    <div class={`fold ${look}${path && isWrong(path) ? " wrong" : ""}`} data-path={path && tagOf(path)}>
      <div class="head">
        <button aria-expanded={isOpen} title={help} onClick={() => setOpen(!isOpen)}>{title}</button>
        {tools}
      </div>
      {isOpen && children}
    </div>
  );
}

function Tool({ what, of, act, children }: { what: string; of: Path; act: () => void; children: ComponentChildren }): JSX.Element {
  return <button class="icon" aria-label={`${what}: ${whereOf(of)}`} title={what} onClick={act}>{children}</button>;
}

// A name, the control, and back to the default where the value is another one; the pointer shows help, unit, range and default.
function Row({ schema, value, path, name, id, children }: Omit<FieldProps, "root"> & { id?: string; children: ComponentChildren }): JSX.Element {
  const changed = value !== undefined && schema.default !== undefined && JSON.stringify(value) !== JSON.stringify(schema.default);
  return (
    <div class={`row${changed ? " changed" : ""}${isWrong(path) ? " wrong" : ""}`} title={aboutOf(schema)} data-path={tagOf(path)}>
      <span class="name"><label for={id}>{labelOf(name)}</label>
        {changed && <button class="icon reset" aria-label={`${nameOf(path, name)} back to the default`} title="Back to the default" onClick={() => remove(path)}>↺</button>}
      </span>
      {children}
    </div>
  );
}

// With a point or a comma; none for what may be read in two ways, as 1,000.
function numberOf(typed: string): number | undefined {
  if (!/^[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?$/i.test(typed) || /^[+-]?[1-9]\d{0,2},\d{3}$/.test(typed)) return undefined;
  const number = Number(typed.replace(",", "."));
  return Number.isFinite(number) ? number : undefined;
}

// A number to type; what is not one, or is refused, goes back to what the recipe has.
interface NumberProps {
  value: string;
  write: (number: number, typed: string) => void;
  id?: string;
  class?: string;
  title?: string;
  "aria-label"?: string;
  onKeyDown?: (event: KeyboardEvent) => void;
}
function NumberInput({ value, write, ...rest }: NumberProps): JSX.Element {
  return (
    <input class="number" type="text" inputMode="decimal" value={value} {...rest} onChange={(event) => {
      const typed = event.currentTarget.value.trim();
      event.currentTarget.value = value;
      const number = numberOf(typed);
      if (number !== undefined) write(number, typed);
    }} />
  );
}

// A slider that is a bar, with the number in it to type.
export function NumberField({ schema, value, path, name }: FieldProps): JSX.Element {
  const id = useId();
  const number = typeof value === "number" ? value : Number(schema.default ?? schema.minimum ?? 0);
  const [slide, setSlide] = useState(() => slideOf(schema, number, number));
  const now = number < slide.low || number > slide.high ? slideOf(schema, number, number) : slide;
  const whole = schema.type === "integer";
  const huge = whole && (schema.maximum ?? Infinity) > 1e9 && schema.minimum === 0;
  const write = (x: number): void => set(path, whole ? Math.round(x) : x);
  const t = toSlider(now, number);
  if (huge) {
    return (
      <Row {...{ schema, value, path, name, id }}>
        <NumberInput id={id} class="text" aria-label={nameOf(path, name)} value={String(value ?? number)} write={(_, typed) => /^\d+$/.test(typed) && void edit([{ path, value: typed }], tagOf(path))} />
        <button class="icon" aria-label={`Another: ${nameOf(path, name)}`} title="Another one" onClick={() => write(Math.floor(Math.random() * 1e6))}>⚄</button>
      </Row>
    );
  }
  return (
    <Row {...{ schema, value, path, name, id }}>
      <span class="slide" style={{ "--t": `${100 * t}%` }}>
        <input id={id} type="range" min="0" max="1" step={whole && !now.logarithmic ? 1 / Math.max(1, now.high - now.low) : 0.001} value={t}
          aria-label={nameOf(path, name)} aria-valuetext={`${number} ${schema.unit ?? ""}`} aria-description={aboutOf(schema)}
          onInput={(event) => {
            const x = fromSlider(now, Number(event.currentTarget.value));
            write(whole ? Math.round(x) : rounded(x, now));
          }}
          onChange={() => setSlide(slideOf(schema, number, number))} />
        {schema.unit && <i class="unit" aria-hidden="true">{schema.unit.replace(/;.*/, "")}</i>}
      </span>
      <NumberInput aria-label={`${nameOf(path, name)}, number`} value={String(Number(number.toPrecision(7)))} write={write}
        onKeyDown={(event) => {
          const step = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
          if (step === 0) return;
          event.preventDefault();
          write(whole ? number + step : rounded(fromSlider(now, t + 0.01 * step), now));
        }} />
    </Row>
  );
}

const kAxes = ["X", "Y", "Z", "T"];
function NumbersField({ schema, value, path, name }: FieldProps): JSX.Element {
  const numbers = (Array.isArray(value) ? value : (schema.default as number[] | undefined) ?? []).map(Number);
  const axis = (i: number): string => (numbers.length === 6 ? `${i < 3 ? "from" : "to"} ${kAxes[i % 3]}` : (kAxes[i] ?? ""));
  return (
    <Row {...{ schema, value, path, name }}>
      <span class={`numbers n${numbers.length}`}>
        {numbers.map((number, i) => (
          <NumberInput key={i} aria-label={`${nameOf(path, name)} ${axis(i)}`} title={axis(i)} value={String(Number(number.toPrecision(6)))}
            write={(changed) => set(path, numbers.map((old, k) => (k === i ? changed : old)))} />
        ))}
      </span>
    </Row>
  );
}

// One number, or two for what it is at both ends of what it follows.
function RangeField({ schema, root, value, path, name }: FieldProps): JSX.Element {
  const [one = {}, two = {}] = schema.oneOf ?? [];
  const text = { description: schema.description ?? "", ...(schema.unit ? { unit: schema.unit } : {}) };
  const range = Array.isArray(value);
  const toggle = (): void => set(path, range ? value[0]! : [(value as number | undefined) ?? Number(schema.default ?? 1), (value as number | undefined) ?? Number(schema.default ?? 1)]);
  return (
    <div class="range">
      {range
        ? <NumbersField schema={{ ...two, ...text }} root={root} value={value} path={path} name={name} />
        : <NumberField schema={{ ...one, ...text, default: schema.default }} root={root} value={value} path={path} name={name} />}
      <button class="icon" aria-pressed={range} aria-label={`${nameOf(path, name)} from end to end`} title={range ? "One number" : "Two numbers, for both ends of what it follows"} onClick={toggle}>⇄</button>
    </div>
  );
}

function WordField({ schema, value, path, name }: FieldProps): JSX.Element {
  const id = useId();
  const words = schema.enum ?? [];
  return (
    <Row {...{ schema, value, path, name, id }}>
      <select id={id} aria-label={nameOf(path, name)} value={String(value ?? schema.default)} onChange={(event) => set(path, event.currentTarget.value)}>
        {words.map((word) => <option key={word} value={String(word)}>{String(word)}</option>)}
      </select>
    </Row>
  );
}

function ToggleField({ schema, value, path, name }: FieldProps): JSX.Element {
  const id = useId();
  return (
    <Row {...{ schema, value, path, name, id }}>
      <input id={id} aria-label={nameOf(path, name)} class="toggle" type="checkbox" role="switch" checked={Boolean(value ?? schema.default)}
        onChange={(event) => set(path, event.currentTarget.checked)} />
    </Row>
  );
}

function TextField({ schema, value, path, name }: FieldProps): JSX.Element {
  const id = useId();
  return (
    <Row {...{ schema, value, path, name, id }}>
      <input id={id} aria-label={nameOf(path, name)} class="text" type="text" value={String(value ?? "")} onChange={(event) => set(path, event.currentTarget.value)} />
    </Row>
  );
}

// One of several kinds of thing, such as noises: its kind, and the fields of that; another kind makes the edits `along`, too.
export function KindField({ schema, root, value, path, name, along = [] }: FieldProps & { along?: Edit[] }): JSX.Element {
  const alternatives = schema.oneOf ?? [];
  const type = isObject(value) ? String(value.type) : typeName(alternatives[0] ?? {});
  const current = alternatives.find((alternative) => typeName(alternative) === type);
  // Kinds that a page has no files for are shown only where a recipe has them.
  const offered = alternatives.filter((alternative) => {
    const needs = Object.values(alternative.properties ?? {}).some((field) => field.type === "object" || (field.type === "string" && !field.enum));
    return typeName(alternative) === type || !needs;
  });
  const change = (alternative: Schema): void => {
    const keep = Object.keys(alternative.properties ?? {}).filter((key) => key !== "type");
    void edit([{ path, value: JSON.stringify({ type: typeName(alternative) }), keep }, ...along], `type ${tagOf(path)}`);
  };
  return (
    <>
      <Choice label={nameOf(path, name)} words={offered.map(typeName)} titles={offered.map(({ description }) => description ?? "")}
        chosen={offered.findIndex((alternative) => typeName(alternative) === type)} choose={(i) => change(offered[i]!)} />
      {current && <ObjectFields schema={current} root={root} value={value} path={path} name={name} skip={["type", "exemplar"]} />}
    </>
  );
}

// The fields of an object; those that it may have and has not wait under a button.
export function ObjectFields({ schema, root, value, path, skip = [] }: FieldProps & { skip?: string[] }): JSX.Element {
  const object = isObject(value) ? value : {};
  const entries = Object.entries(schema.properties ?? {}).filter(([key]) => !skip.includes(key) && (key !== "combine" || object.layers !== undefined));
  const shown = entries.filter(([key, field]) => key in object || field.default !== undefined);
  const hidden = entries.filter(([key, field]) => !(key in object) && field.default === undefined && startOf(field, root) !== undefined);
  return (
    <>
      {shown.map(([key, field]) => (
        <Field key={key} schema={field} root={root} value={object[key]} path={[...path, key]} name={key} />
      ))}
      {hidden.length > 0 && (
        <div class="more">
          {hidden.map(([key, field]) => (
            <button key={key} aria-label={`+ ${nameOf([...path, key], key)}`} title={field.description ?? ""} onClick={() => set([...path, key], startOf(field, root)!)}>+ {labelOf(key).toLowerCase()}</button>
          ))}
        </div>
      )}
    </>
  );
}

// What a field that is not there begins as; none for what the page cannot make, such as files.
export function startOf(field: Schema, root: Schema): Json | undefined {
  const schema = resolved(field, root);
  if (schema.default !== undefined) return schema.default as Json;
  if (schema.enum) return schema.enum[0] as Json;
  if (schema.oneOf) return { type: typeName(schema.oneOf[0] ?? {}) };
  if (schema.type === "array" && schema.items?.type === "array") return [[-1, -1], [1, 1]];
  if (schema.type === "array" && resolved(schema.items ?? {}, root).type === "object") return [{}];
  if (schema.type === "object" && schema.properties) {
    // An object with a text that has no default wants a file.
    return Object.values(schema.properties).some((part) => part.type === "string" && part.default === undefined && !part.enum && /\.vdb/.test(part.description ?? "")) ? undefined : {};
  }
  if (schema.type === "boolean") return false;
  if (schema.type === "number" || schema.type === "integer") return Math.max(schema.minimum ?? 0, schema.exclusiveMinimum === undefined ? 0 : 1);
  return undefined;
}

function ListField({ schema, root, value, path, name }: FieldProps): JSX.Element {
  const items = Array.isArray(value) ? value : [];
  const item = resolved(schema.items ?? {}, root);
  const removeAt = (i: number): void => (items.length > 1 ? remove([...path, i]) : remove(path));
  const move = (i: number, by: number): void => {
    const moved = items.slice();
    const [taken] = moved.splice(i, 1);
    moved.splice(i + by, 0, taken!);
    set(path, moved);
  };
  return (
    <div class="cards">
      {items.map((one, i) => (
        <Fold key={i} look="card" title={summaryOf(one, i)} open={items.length < 4} tools={
          <>
            {i > 0 && <Tool what="Up" of={[...path, i]} act={() => move(i, -1)}>↑</Tool>}
            <Tool what="Copy" of={[...path, i]} act={() => set(path, [...items.slice(0, i + 1), one, ...items.slice(i + 1)])}><svg viewBox="0 0 16 16" aria-hidden="true"><path d="M5 5h8v8H5zM3 11V3h8" /></svg></Tool>
            <Tool what="Remove" of={[...path, i]} act={() => removeAt(i)}>×</Tool>
          </>
        }>
          <ObjectFields schema={item} root={root} value={one} path={[...path, i]} name={name} />
        </Fold>
      ))}
      <button class="add" onClick={() => set(path, [...items, startOf(item, root) ?? {}])}>+ Add {labelOf(name).toLowerCase().replace(/s$/, "")}</button>
    </div>
  );
}

// What a card is about, in a few words.
function summaryOf(value: Json, i: number): string {
  if (!isObject(value)) return `${i + 1}`;
  const own = isObject(value.noise) ? String(value.noise.type) : undefined;
  const words = [value.use, value.place !== "none" && value.place, value.layers && value.combine, own, value.fold !== "none" && value.fold].filter(
    (word): word is string => typeof word === "string" && word !== "");
  return words.length > 0 ? words.join(", ") : "the recipe's noise";
}

function NamedField({ schema, root, value, path, name }: FieldProps): JSX.Element {
  const item = resolved(schema.additionalProperties as Schema, root);
  const entries = isObject(value) ? Object.entries(value) : [];
  return (
    <div class="cards">
      {entries.map(([key, one]) => (
        <Fold key={key} look="card" title={key} open={false} tools={<Tool what="Remove" of={[...path, key]} act={() => remove([...path, key])}>×</Tool>}>
          <ObjectFields schema={item} root={root} value={one} path={[...path, key]} name={name} />
        </Fold>
      ))}
    </div>
  );
}

export function Field(props: FieldProps): JSX.Element | null {
  const schema = resolved(props.schema, props.root);
  const own = { ...props, schema };
  const { value, path, name } = own;
  const optional = schema.default === undefined && value !== undefined;
  if (schema.oneOf && !typeName(schema.oneOf[0] ?? {})) return <RangeField {...own} />;
  if (schema.oneOf) return <Group {...own} optional={props.schema.$ref !== undefined}><KindField {...own} /></Group>;
  if (schema.enum) return <WordField {...own} />;
  if (schema.type === "boolean") return <ToggleField {...own} />;
  if (schema.type === "number" || schema.type === "integer") return <NumberField {...own} />;
  if (schema.type === "string") return <TextField {...own} />;
  if (schema.type === "array") {
    if (schema.items?.type === "number") return <NumbersField {...own} />;
    if (schema.items?.type === "array") return <Group {...own} optional><RampEditor value={value} path={path} name={name} /></Group>;
    return <Group {...own} optional={optional}><ListField {...own} /></Group>;
  }
  if (schema.properties) return <Group {...own} optional={optional}><ObjectFields {...own} /></Group>;
  if (typeof schema.additionalProperties === "object") return <NamedField {...own} />;
  return null;
}

function Group({ schema, path, name, value, optional, children }: FieldProps & { optional?: boolean | undefined; children: ComponentChildren }): JSX.Element {
  return (
    <Fold look="group" title={labelOf(name)} open={value !== undefined} help={schema.description ?? ""} path={path}
      tools={optional && value !== undefined && <Tool what="Remove" of={path} act={() => remove(path)}>×</Tool>}>
      {children}
    </Fold>
  );
}
