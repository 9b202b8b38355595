// The little of WebGL2 that both views share.

export const kNoWebGl = "This browser shows no WebGL 2, which volumes and surfaces are drawn with. Slices, spectra and recipes work without it.";

export function contextOf(canvas: OffscreenCanvas): WebGL2RenderingContext {
  const gl = canvas.getContext("webgl2");
  if (!gl) throw new Error(kNoWebGl);
  return gl;
}

export function programOf(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const program = gl.createProgram();
  const shaders = ([[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const).map(([type, source]) => {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\nprecision highp sampler3D;\n${source}`);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(shaders.map((shader) => gl.getShaderInfoLog(shader)).find((log) => log) || gl.getProgramInfoLog(program) || "shaders do not link");
  }
  return program;
}

export function lookAt(eye: readonly number[], up: readonly number[] = [0, 1, 0]): { right: number[]; up: number[]; forward: number[] } {
  const length = Math.hypot(...eye);
  const forward = eye.map((x) => -x / length);
  const cross = (a: readonly number[], b: readonly number[]): number[] => [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
  const right = cross(forward, up);
  const n = Math.hypot(...right) || 1;
  const unitRight = right.map((x) => x / n);
  return { right: unitRight, up: cross(unitRight, forward), forward };
}
