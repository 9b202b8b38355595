import { lookAt, programOf } from "./gl.ts";

const kLooks = ["cloud", "glow", "solid", "fire", "smoke"] as const;
export type VolumeLook = (typeof kLooks)[number];

export interface VolumeData {
  size: [number, number, number];
  values: Float32Array<ArrayBuffer>; // x slowest, z fastest
  range: [number, number]; // of the values
  light: Float32Array<ArrayBuffer> | undefined; // optical depth to the sun
  glow: Float32Array<ArrayBuffer>[]; // of a fire: temperatures in kelvin, and the share that glows where it is not 1
  factor: number; // from values to extinction per world unit
  sides: [number, number, number]; // of the box, world units
  look: VolumeLook;
  sun: number[]; // where it is from, in the world
  up: 1 | 2;
  ramp: Float32Array;
}
export interface VolumeShot {
  eye: number[]; // in radii of the box, from its centre
  cut: number; // how large a corner of a body is cut off, 0 to 1
}

// A vector with the Y axis up as the world has it, which with the Z axis up is turned about x.
export const turned = (v: readonly number[], up: 1 | 2): number[] => (up === 2 ? [v[0]!, -v[2]!, v[1]!] : [...v]);

const kVertex = `
const vec2 corners[3] = vec2[](vec2(-1, -1), vec2(3, -1), vec2(-1, 3));
out vec2 place;
void main() { place = corners[gl_VertexID]; gl_Position = vec4(place, 0, 1); }`;

// Rays through the box, from the front: extinction by the densities, light of the sun by the depth that each voxel knows, as often
// scattered light fills the shadows; or the first surface of what is above a value, lit by its gradient. Textures have z first.
const kFragment = `
in vec2 place;
out vec4 color;
uniform sampler3D values, light;
uniform sampler2D ramp;
uniform vec3 eye, right, up, forward, halfSides, sun, vertical;
uniform vec2 aspect;
uniform float factor, cut, low, high;
uniform int look, steps;

float hash(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }
vec3 at(vec3 p) { return (p / halfSides * 0.5 + 0.5).zyx; }
vec3 sky(vec3 d) {
  float t = 0.5 + 0.5 * dot(d, vertical);
  return mix(vec3(0.10, 0.13, 0.19), vec3(0.22, 0.36, 0.58), smoothstep(0.1, 1.0, t));
}
// Overcast, as of vdbnoise's previews of smoke.
vec3 haze(vec3 d) { return vec3(0.68, 0.68, 0.67) - 0.22 * (0.5 + 0.5 * dot(d, vertical)) * vec3(1.0, 0.95, 0.85); }
vec3 encoded(vec3 c) { return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-5)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
// Linear light of a black body, with 1 for the mean of its channels at 2000 K: as of vdbnoise's previews.
vec3 blackBody(float kelvin) {
  vec3 c = exp(-1.4388e7 / vec3(610, 549, 464) * (1.0 / kelvin - 1.0 / 6500.0));
  return c * (3.0 / (c.r + c.g + c.b) * pow(kelvin / 2000.0, 4.0));
}
// What is brighter than white nears it.
vec3 shouldered(vec3 c) { return mix(c, 1.0 - 0.4 * exp(-(c - 0.6) / 0.4), step(0.6, c)); }
float phase(float cosine, float g) { return (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * cosine, 1.5); }

void main() {
  vec3 d = normalize(forward + place.x * aspect.x * right + place.y * aspect.y * up);
  vec3 a = (-halfSides - eye) / d, b = (halfSides - eye) / d;
  vec3 near3 = min(a, b), far3 = max(a, b);
  float from = max(max(near3.x, near3.y), max(near3.z, 0.0)), to = min(far3.x, min(far3.y, far3.z));
  vec3 back = look == 0 ? sky(d) : look == 4 ? haze(d) : look == 1 ? vec3(0.004, 0.005, 0.010) : look == 3 ? vec3(0) : mix(vec3(0.035), vec3(0.075), 0.5 - 0.4 * place.y);
  if (from >= to) { color = vec4(encoded(back) + (hash(gl_FragCoord.yx) - 0.5) / 255.0, 1); return; }
  float stride = length(2.0 * halfSides) / float(steps);
  vec3 sum = vec3(0);
  float through = 1.0;
  float t = from + stride * hash(gl_FragCoord.xy);
  if (look == 2) {
    // A body with a corner cut off, and only what is above the value where one is asked for.
    vec3 normal = vec3(0);
    bool hit = false;
    for (t = from; t < to; t += 0.5 * stride) {
      vec3 p = eye + t * d;
      bool gone = cut > 0.0 && all(greaterThan(p / halfSides, vec3(1.0 - 2.0 * cut)));
      if (gone) continue;
      hit = true;
      break;
    }
    if (!hit) { color = vec4(encoded(back), 1); return; }
    vec3 p = eye + t * d;
    vec3 q = p / halfSides;
    vec3 corner = vec3(1.0 - 2.0 * cut);
    vec3 outer = abs(abs(q) - 1.0), inner = abs(q - corner);
    float least = 1e9;
    for (int i = 0; i < 3; ++i) {
      if (outer[i] * halfSides[i] < least) { least = outer[i] * halfSides[i]; normal = vec3(0); normal[i] = sign(q[i]); }
      if (cut > 0.0 && inner[i] * halfSides[i] < least && t > from + 0.25 * stride) { least = inner[i] * halfSides[i]; normal = vec3(0); normal[i] = 1.0; }
    }
    float value = texture(values, at(p)).r;
    vec3 body = texture(ramp, vec2(clamp((value - low) / (high - low), 0.0, 1.0), 0.5)).rgb;
    body = pow(body, vec3(2.2));
    float lit = 0.35 + 0.65 * max(0.0, dot(normal, normalize(sun)));
    color = vec4(encoded(body * lit), 1);
    return;
  }
  float cosine = dot(d, normalize(sun));
  float forwardLobe = 0.75 * phase(cosine, 0.45) + 0.25 * phase(cosine, -0.2);
  for (int i = 0; i < 512; ++i) {
    if (t >= to || through < 0.004) break;
    vec3 p = eye + t * d;
    float density = texture(values, at(p)).r * factor;
    if (look == 3) {
      vec3 lit = texture(light, at(p)).rgb;
      float dimmed = exp(-density * stride);
      vec3 sent = max(0.0, density) * vec3(0.45, 0.42, 0.39) * (vec3(0.05, 0.06, 0.085) + vec3(0.60, 0.57, 0.54) * exp(-0.5 * lit.r));
      if (lit.g > 0.5) sent += 4.0 / max(halfSides.x, max(halfSides.y, halfSides.z)) * max(0.0, lit.b) * blackBody(1000.0 * lit.g);
      sum += through * sent * 0.5 * (1.0 + dimmed) * stride;
      through *= dimmed;
    } else if (density > 0.0) {
      float absorbed = 1.0 - exp(-density * stride);
      if (look == 1) {
        float heat = clamp(density * 0.12, 0.0, 1.0);
        vec3 glow = mix(vec3(0.10, 0.02, 0.20), vec3(0.85, 0.25, 0.35), smoothstep(0.0, 0.5, heat));
        glow = mix(glow, vec3(1.0, 0.85, 0.65), smoothstep(0.45, 1.0, heat));
        sum += through * absorbed * glow * 2.0;
      } else {
        float depth = texture(light, at(p)).r;
        // Light scattered once, and many times: as if through thinner clouds (Wrenninge 2015).
        float direct = 0.0, weight = 1.0, thin = 1.0;
        for (int k = 0; k < 4; ++k) { direct += weight * exp(-depth * thin); weight *= 0.5; thin *= 0.3; }
        vec3 ambient = mix(vec3(0.16, 0.20, 0.27), vec3(0.30, 0.40, 0.55), 0.5 + 0.5 * dot(p / halfSides, vertical));
        vec3 here = vec3(1.0, 0.92, 0.80) * direct * 0.56 * mix(1.0, forwardLobe, 0.5) + ambient * 0.42;
        if (look == 4) here *= vec3(0.28, 0.272, 0.265);
        sum += through * absorbed * here;
      }
      through *= 1.0 - absorbed;
    }
    t += stride;
  }
  color = vec4(encoded(look == 3 ? shouldered(sum) : sum + through * back) + (hash(gl_FragCoord.yx) - 0.5) / 255.0, 1);
}`;

// Depth to the sun, thousands of kelvin, and what share of them glows: side by side, as all are looked up together.
function heated({ values, light, glow: [kelvin, share] }: VolumeData): Float32Array {
  const all = new Float32Array(3 * values.length);
  for (let i = 0; i < values.length; ++i) {
    all[3 * i] = light![i]!;
    all[3 * i + 1] = kelvin![i]! / 1000;
    all[3 * i + 2] = share ? share[i]! : 1;
  }
  return all;
}

export class VolumeRenderer {
  private readonly program: WebGLProgram;
  private readonly textures: WebGLTexture[];
  private data: VolumeData | undefined;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = programOf(gl, kVertex, kFragment);
    this.textures = [0, 1, 2].map(() => gl.createTexture());
    gl.bindVertexArray(gl.createVertexArray());
  }

  load(data: VolumeData): void {
    const { gl } = this;
    this.data = data;
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const [nx, ny, nz] = data.size;
    const fill = (unit: number, values: Float32Array, format: [number, number] = [gl.R16F, gl.RED]): void => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_3D, this.textures[unit]!);
      gl.texImage3D(gl.TEXTURE_3D, 0, format[0], nz, ny, nx, 0, format[1], gl.FLOAT, values);
      gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
      gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
      for (const wrap of [gl.TEXTURE_WRAP_R, gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_3D, wrap, gl.CLAMP_TO_EDGE);
    };
    fill(0, data.values);
    if (data.look === "fire") fill(1, heated(data), [gl.RGB16F, gl.RGB]);
    else fill(1, data.light ?? data.values);
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, this.textures[2]!);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, Uint8Array.from(data.ramp, (x) => Math.round(255 * x)));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  }

  render({ eye: from, cut }: VolumeShot): void {
    const { gl, data, program } = this;
    if (!data) return;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.useProgram(program);
    const at = (name: string): WebGLUniformLocation | null => gl.getUniformLocation(program, name);
    const radius = 0.5 * Math.hypot(...data.sides);
    // A body fills its box, a cloud the middle of it.
    const eye = from.map((x) => x * radius * (data.look === "solid" ? 1.35 : 1));
    const { right, up, forward } = lookAt(eye);
    gl.uniform3fv(at("eye"), turned(eye, data.up));
    gl.uniform3fv(at("right"), turned(right, data.up));
    gl.uniform3fv(at("up"), turned(up, data.up));
    gl.uniform3fv(at("forward"), turned(forward, data.up));
    gl.uniform3fv(at("halfSides"), data.sides.map((x) => x / 2));
    gl.uniform3fv(at("sun"), data.sun);
    gl.uniform3fv(at("vertical"), turned([0, 1, 0], data.up));
    const field = 0.42;
    const ratio = gl.drawingBufferWidth / gl.drawingBufferHeight;
    gl.uniform2f(at("aspect"), ratio > 1 ? field * ratio : field, ratio > 1 ? field : field / ratio);
    gl.uniform1f(at("factor"), data.factor);
    gl.uniform1f(at("cut"), cut);
    const [low, high] = data.range;
    gl.uniform1f(at("low"), low);
    gl.uniform1f(at("high"), high > low ? high : low + 1);
    gl.uniform1i(at("look"), kLooks.indexOf(data.look));
    gl.uniform1i(at("steps"), Math.min(300, Math.ceil(1.7 * Math.max(...data.size))));
    gl.uniform1i(at("values"), 0);
    gl.uniform1i(at("light"), 1);
    gl.uniform1i(at("ramp"), 2);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
