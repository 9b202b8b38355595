import { lookAt, programOf } from "./gl.ts";

export interface SurfaceData {
  positions: Float32Array;
  normals: Float32Array;
  colors: Float32Array; // linear light
  corners: Uint32Array;
}
export interface SurfaceShot {
  eye: number[]; // in radii of the surface, from its centre
  plain: boolean; // colours without light
}

const kVertex = `
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform vec3 centre, eye, right, up, forward;
uniform float radius;
uniform vec2 aspect;
out vec3 bodyColor, across, towards;
void main() {
  vec3 p = (position - centre) / radius;
  vec3 seen = p - eye;
  float depth = dot(seen, forward);
  gl_Position = vec4(dot(seen, right) / aspect.x, dot(seen, up) / aspect.y, (depth - 0.05) / 16.0 * depth * 2.0 - depth, depth);
  bodyColor = color; across = normal; towards = -seen;
}`;

// A key light over the shoulder, sky and ground, and a soft gloss; colours are those that were baked.
const kFragment = `
in vec3 bodyColor, across, towards;
out vec4 result;
uniform vec3 right, up, forward;
uniform int plain;
vec3 encoded(vec3 c) { return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-5)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() {
  if (plain == 1) { result = vec4(encoded(bodyColor), 1); return; }
  vec3 n = normalize(across), v = normalize(towards);
  if (dot(n, v) < 0.0) n = -n;
  vec3 key = normalize(-0.45 * right + 0.75 * up - 0.6 * forward);
  float lit = max(0.0, dot(n, key));
  vec3 sky = mix(vec3(0.10, 0.09, 0.08), vec3(0.34, 0.38, 0.44), 0.5 + 0.5 * n.y);
  vec3 rim = vec3(0.10, 0.12, 0.16) * pow(1.0 - max(0.0, dot(n, v)), 3.0);
  float gloss = 0.10 * pow(max(0.0, dot(n, normalize(key + v))), 28.0);
  result = vec4(encoded(bodyColor * (vec3(1.0, 0.96, 0.90) * 0.95 * lit + sky) + rim + gloss), 1);
}`;

export class SurfaceRenderer {
  private readonly program: WebGLProgram;
  private readonly buffers: WebGLBuffer[];
  private count = 0;
  private centre = [0, 0, 0];
  private radius = 1;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = programOf(gl, kVertex, kFragment);
    this.buffers = [0, 1, 2, 3].map(() => gl.createBuffer());
    gl.bindVertexArray(gl.createVertexArray());
  }

  load({ positions, normals, colors, corners }: SurfaceData): void {
    const { gl } = this;
    [positions, normals, colors].forEach((values, place) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[place]!);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers[3]!);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    this.count = corners.length;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; ++i) {
      low[i % 3] = Math.min(low[i % 3]!, positions[i]!);
      high[i % 3] = Math.max(high[i % 3]!, positions[i]!);
    }
    this.centre = low.map((x, axis) => (x + high[axis]!) / 2);
    this.radius = 0.5 * Math.hypot(...low.map((x, axis) => high[axis]! - x)) || 1;
  }

  render({ eye, plain }: SurfaceShot): void {
    const { gl, program } = this;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    const at = (name: string): WebGLUniformLocation | null => gl.getUniformLocation(program, name);
    const { right, up, forward } = lookAt(eye);
    gl.uniform3fv(at("centre"), this.centre);
    gl.uniform1f(at("radius"), this.radius);
    gl.uniform3fv(at("eye"), eye);
    gl.uniform3fv(at("right"), right);
    gl.uniform3fv(at("up"), up);
    gl.uniform3fv(at("forward"), forward);
    const ratio = gl.drawingBufferWidth / gl.drawingBufferHeight;
    gl.uniform2f(at("aspect"), ratio > 1 ? 0.42 * ratio : 0.42, ratio > 1 ? 0.42 : 0.42 / ratio);
    gl.uniform1i(at("plain"), plain ? 1 : 0);
    gl.drawElements(gl.TRIANGLES, this.count, gl.UNSIGNED_INT, 0);
  }
}
