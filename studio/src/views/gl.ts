// The little of WebGL2 that both views share.

export function contextOf(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) throw new Error("This browser shows no WebGL 2, which volumes and surfaces are drawn with. Slices, spectra and recipes work without it.");
  return gl;
}

// Compiled beside the page where the browser can.
export async function programOf(gl: WebGL2RenderingContext, vertex: string, fragment: string): Promise<WebGLProgram> {
  const program = gl.createProgram();
  const shaders = ([[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const).map(([type, source]) => {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\nprecision highp sampler3D;\n${source}`);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  const beside = gl.getExtension("KHR_parallel_shader_compile");
  while (beside && !gl.isContextLost() && !gl.getProgramParameter(program, beside.COMPLETION_STATUS_KHR)) await new Promise((done) => setTimeout(done, 10));
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(shaders.map((shader) => gl.getShaderInfoLog(shader)).find((log) => log) || gl.getProgramInfoLog(program) || "shaders do not link");
  }
  return program;
}

export type Matrix = Float32Array;

export function lookAt(eye: readonly number[], up: readonly number[] = [0, 1, 0]): { right: number[]; up: number[]; forward: number[] } {
  const length = Math.hypot(...eye);
  const forward = eye.map((x) => -x / length);
  const cross = (a: readonly number[], b: readonly number[]): number[] => [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
  const right = cross(forward, up);
  const n = Math.hypot(...right) || 1;
  const unitRight = right.map((x) => x / n);
  return { right: unitRight, up: cross(unitRight, forward), forward };
}
