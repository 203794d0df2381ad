// SPDX-License-Identifier: GPL-2.0-or-later
// The view of a run: what viewing.py has written is unpacked, and drawn by WebGL 2 with nothing else than is in the page.
'use strict';
const byId = id => document.getElementById(id);
const data = JSON.parse(byId('data').textContent);

// ---- unpacking: base64 of deflated arrays; a frame may be what has changed since the one before it
async function unpack(text) {
	const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
	return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer();
}

async function unpackFrames() {
	let before = null;
	for (const frame of data.frames) {
		const values = new Uint16Array(await unpack(frame.points));
		if (frame.sinceLast) for (let i = 0; i < values.length; ++i) values[i] += before[i];
		before = frame.values = values;
		for (const kind of ['spheres', 'boxes', 'triangles'])
			frame[kind] = frame[kind] === null ? data.frames[data.frames.indexOf(frame) - 1][kind] : new Float32Array(await unpack(frame[kind]));
	}
}

// ---- small vectors
const sub = (a, b) => a.map((x, i) => x - b[i]), dot = (a, b) => a.reduce((s, x, i) => s + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const n = Math.hypot(...a) || 1; return a.map(x => x / n); };

// ---- what is shown
const low = data.low, high = data.high, size = Math.hypot(...sub(high, low)) || 1;
const up = data.up, flat = data.dim === 2;
const state = { frame: 0, field: 0, right: [1, 0, 0], upwards: [0, 1, 0], middle: [0, 0, 0], zoom: 1, playing: false };

function home() {
	state.middle = low.map((x, i) => (x + high[i]) / 2);
	if (flat) { state.right = [1, 0, 0]; state.upwards = [0, 1, 0]; }
	else {
		const other = [(up + 1) % 3, (up + 2) % 3], towards = [0, 0, 0];
		towards[up] = 0.55; towards[other[0]] = up === 2 ? 0.45 : 0.8; towards[other[1]] = up === 2 ? -1 : 0.45;
		if (up === 1) { towards[2] = 1; towards[0] = 0.5; }
		const axis = [0, 0, 0]; axis[up] = 1;
		state.right = unit(cross(axis, towards)); state.upwards = unit(cross(towards, state.right));
	}
	const box = [state.right, state.upwards].map(e => e.reduce((s, x, i) => s + Math.abs(x) * (high[i] - low[i]), 0));
	const ratio = gl.canvas.width / gl.canvas.height;
	state.zoom = Math.max(0.55 * box[1], 0.66 * box[0] / ratio) || 1; // half of the height that is seen [m]
}

// ---- WebGL
const gl = byId('canvas').getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
const common = `#version 300 es
precision highp float; precision highp int;`;
const view = `
uniform vec3 right, upwards, towards, middle; uniform vec2 scale; uniform float depth;
vec4 project(vec3 x) { x -= middle; return vec4(dot(x, right) * scale.x, dot(x, upwards) * scale.y, -dot(x, towards) * depth, 1); }`;
const shade = `
uniform vec4 cut; uniform sampler2D colours; uniform vec2 bounds; uniform bool ids;
bool isCut(vec3 x) { return dot(cut.xyz, x) > cut.w; }
vec3 colourOf(float value, vec3 own, bool isOwn) {
	return isOwn ? own : texture(colours, vec2((clamp((value - bounds.x) / (bounds.y - bounds.x), 0., 1.) * 255. + .5) / 256., .5)).rgb; }
vec4 idOf(int id) { return vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.) / 255.; }`;

function program(vertex, fragment) {
	const made = gl.createProgram();
	for (const [kind, text] of [[gl.VERTEX_SHADER, common + view + vertex], [gl.FRAGMENT_SHADER, common + view.split('\n')[1] + shade + fragment]]) {
		const shader = gl.createShader(kind);
		gl.shaderSource(shader, text);
		gl.compileShader(shader);
		if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw Error(gl.getShaderInfoLog(shader));
		gl.attachShader(made, shader);
	}
	gl.linkProgram(made);
	if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw Error(gl.getProgramInfoLog(made));
	return made;
}

const boxShader = [`
in vec3 corner, normal, centre, e0, e1, e2; in vec4 own; uniform bool isOwn;
out vec3 place, at, face; flat out vec4 tone; flat out int number; flat out vec3 outward;
void main() {
	place = centre + corner.x * e0 + corner.y * e1 + corner.z * e2;
	at = corner; face = normal; tone = own; number = int(own.w);
	outward = normal.x * cross(e1, e2) + normal.y * cross(e2, e0) + normal.z * cross(e0, e1);
	gl_Position = project(place);
}`, `
in vec3 place, at, face; flat in vec4 tone; flat in int number; flat in vec3 outward; uniform bool isOwn, edges; out vec4 colour;
void main() {
	if (isCut(place)) discard;
	if (ids) { colour = isOwn ? vec4(0) : idOf(number); return; }
	vec3 base = colourOf(tone.x, tone.rgb, isOwn);
	float light = gl_FrontFacing && dot(outward, outward) > 0. ? .62 + .38 * abs(dot(normalize(outward), towards)) : 1.; // what a cut lays open is as bright as can be
	vec3 beside = 1. - abs(at) + abs(face);
	float edge = min(min(beside.x, beside.y), beside.z), width = fwidth(at.x) + fwidth(at.y) + fwidth(at.z);
	if (edges && gl_FrontFacing && edge < .7 * width) light *= mix(1., .72, clamp(1.2 - 4. * width, 0., 1.));
	colour = vec4(base * light, 1);
}`];
const sphereShader = [`
in vec2 corner; in vec3 centre; in float radius; in vec4 own; uniform bool isOwn;
out vec2 at; flat out vec3 middleOf; flat out float size; flat out vec4 tone; flat out int number;
void main() {
	at = corner; middleOf = centre; size = radius; tone = own; number = int(own.w);
	gl_Position = project(centre + radius * (corner.x * right + corner.y * upwards));
}`, `
in vec2 at; flat in vec3 middleOf; flat in float size; flat in vec4 tone; flat in int number; uniform bool isOwn; out vec4 colour;
void main() {
	float square = 1. - dot(at, at);
	if (square < 0.) discard;
	vec3 n = at.x * right + at.y * upwards + sqrt(square) * towards, place = middleOf + size * n;
	bool inner = isCut(place);
	if (inner) { n -= 2. * sqrt(square) * towards; place = middleOf + size * n; if (isCut(place)) discard; }
	gl_FragDepth = .5 - .5 * dot(place - middle, towards) * depth;
	if (ids) { colour = isOwn ? vec4(0) : idOf(number); return; }
	colour = vec4(colourOf(tone.x, tone.rgb, isOwn) * (inner ? 1. : .55 + .45 * sqrt(square)), 1);
}`];
const triangleShader = [`
in vec3 centre; in vec4 own; uniform bool isOwn; out vec3 place; flat out vec4 tone;
void main() { place = centre; tone = own; gl_Position = project(centre); }`, `
in vec3 place; flat in vec4 tone; uniform bool isOwn; out vec4 colour;
void main() {
	if (isCut(place)) discard;
	if (ids) { colour = vec4(0); return; }
	colour = vec4(tone.rgb * (.6 + .4 * abs(dot(normalize(cross(dFdx(place), dFdy(place))), towards))), 1);
}`];

// Corners of a cube, six faces of two triangles each, and their normals.
function cube() {
	const corners = [], normals = [];
	for (const axis of [0, 1, 2]) for (const side of [-1, 1]) for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) {
		const corner = [0, 0, 0], normal = [0, 0, 0];
		corner[axis] = normal[axis] = side; corner[(axis + 1) % 3] = side * u; corner[(axis + 2) % 3] = v;
		corners.push(...corner); normals.push(...normal);
	}
	return [corners, normals];
}

class Drawn { // instances of one shape, or triangles
	constructor(shader, shape, layout) {
		this.program = program(...shader);
		this.array = gl.createVertexArray();
		this.layout = layout;
		this.stride = layout.reduce((sum, [, width]) => sum + width, 0);
		this.buffer = gl.createBuffer();
		gl.bindVertexArray(this.array);
		for (const [name, values, width] of shape) this.attribute(name, gl.createBuffer(), new Float32Array(values), width, 4 * width, 0, 0);
		this.corners = shape.length ? shape[0][1].length / shape[0][2] : 0;
		let offset = 0;
		for (const [name, width] of layout) {
			this.attribute(name, this.buffer, null, width, 4 * this.stride, 4 * offset, this.corners ? 1 : 0);
			offset += width;
		}
		this.count = 0;
	}

	attribute(name, buffer, values, width, stride, offset, each) {
		const place = gl.getAttribLocation(this.program, name);
		gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
		if (values) gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
		if (place < 0) return;
		gl.enableVertexAttribArray(place);
		gl.vertexAttribPointer(place, width, gl.FLOAT, false, stride, offset);
		gl.vertexAttribDivisor(place, each);
	}

	fill(values) {
		this.count = values.length / this.stride;
		gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
		gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
	}

	draw(isOwn, uniforms) {
		if (!this.count) return;
		gl.useProgram(this.program);
		gl.bindVertexArray(this.array);
		for (const [name, value] of Object.entries({ ...uniforms, isOwn })) {
			const place = gl.getUniformLocation(this.program, name);
			if (place === null) continue;
			if (Array.isArray(value)) gl[`uniform${value.length}fv`](place, value);
			else if (typeof value === 'boolean' || name === 'colours') gl.uniform1i(place, value);
			else gl.uniform1f(place, value);
		}
		if (this.corners) gl.drawArraysInstanced(gl.TRIANGLES, 0, this.corners, this.count);
		else gl.drawArrays(gl.TRIANGLES, 0, this.count);
	}
}

let shapes, texture;
function makeShapes() {
	const [corners, normals] = cube(), square = [-1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, 1];
	const box = () => new Drawn(boxShader, [['corner', corners, 3], ['normal', normals, 3]], [['centre', 3], ['e0', 3], ['e1', 3], ['e2', 3], ['own', 4]]);
	const sphere = () => new Drawn(sphereShader, [['corner', square, 2]], [['centre', 3], ['radius', 1], ['own', 4]]);
	shapes = { points: box(), dots: sphere(), boxes: box(), spheres: sphere(), triangles: new Drawn(triangleShader, [], [['centre', 3], ['own', 4]]) };
	texture = gl.createTexture();
	gl.bindTexture(gl.TEXTURE_2D, texture);
	for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
		gl.texParameteri(gl.TEXTURE_2D, name, value);
	gl.enable(gl.DEPTH_TEST);
}

// ---- a frame into buffers
const stretched = (q, [from, to]) => from + q / 65535 * (to - from);
const rows = frame => frame.values.length / data.columns;
const valueOf = (frame, row, field) => stretched(frame.values[(data.columns - data.fields.length + field) * rows(frame) + row], data.fields[field].stored);

function pointOf(frame, row) {
	const n = rows(frame), column = c => frame.values[c * n + row], dim = data.dim;
	const centre = [0, 0, 0], edges = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
	for (let i = 0; i < dim; ++i) centre[i] = stretched(column(i), [low[i], high[i]]);
	for (let i = 0; i < dim; ++i) for (let j = 0; j < dim; ++j) edges[j][i] = stretched(column(dim + i * dim + j), [-data.reach, data.reach]);
	if (flat) edges[2][2] = 1e-4 * size; // seen from in front
	return { centre, edges, radius: stretched(column(dim + dim * dim), [0, data.reach]), isDot: column(dim + dim * dim) > 0 };
}

function showFrame() {
	const frame = data.frames[state.frame], boxes = [], dots = [];
	for (let row = 0; row < rows(frame); ++row) {
		const point = pointOf(frame, row), value = valueOf(frame, row, state.field);
		if (point.isDot) dots.push(...point.centre, point.radius, value, 0, 0, row + 1);
		else boxes.push(...point.centre, ...point.edges[0], ...point.edges[1], ...point.edges[2], value, 0, 0, row + 1);
	}
	shapes.points.fill(new Float32Array(boxes));
	shapes.dots.fill(new Float32Array(dots));
	for (const kind of ['boxes', 'spheres', 'triangles']) shapes[kind].fill(frame[kind]);
	byId('frame').value = state.frame;
	byId('moment').textContent = frame.title;
	draw();
}

function uniforms(ids) {
	const { width, height } = gl.canvas, axis = byId('axis').value, side = byId('other').checked ? -1 : 1;
	const cut = [0, 0, 0, 1];
	if (axis !== '') { cut[axis] = side; cut[3] = side * (low[axis] + byId('at').value * (high[axis] - low[axis])); }
	const field = data.fields[state.field];
	return { right: state.right, upwards: state.upwards, towards: cross(state.right, state.upwards), middle: state.middle, scale: [height / width / state.zoom, 1 / state.zoom],
		depth: 1 / (4 * size), cut, colours: 0, bounds: [field.low, field.high], ids, edges: byId('edges').checked };
}

function draw(ids = false) {
	gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
	gl.clearColor(...(ids ? [0, 0, 0, 0] : [1, 1, 1, 1]));
	gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
	const given = uniforms(ids);
	shapes.points.draw(false, given);
	shapes.dots.draw(false, given);
	if (byId('bodies').checked) for (const kind of ['boxes', 'spheres', 'triangles']) shapes[kind].draw(true, given);
	if (!ids) drawAxes();
}

function drawAxes() {
	byId('axes').innerHTML = [0, 1, 2].slice(0, data.dim).map(i => {
		const x = 28 * state.right[i], y = -28 * state.upwards[i];
		return `<line x1="0" y1="0" x2="${x}" y2="${y}" stroke="#495057" stroke-width="2"/><text x="${1.25 * x - 3}" y="${1.25 * y + 4}" font-size="12">${'xyz'[i]}</text>`;
	}).join('');
}

// ---- colours and their bar
const short = x => Math.abs(x) >= 1e4 || x && Math.abs(x) < 1e-3 ? x.toExponential(2) : String(+x.toPrecision(4));

function showField() {
	const field = data.fields[state.field], colours = Uint8Array.from(atob(field.colours), c => c.charCodeAt(0));
	gl.bindTexture(gl.TEXTURE_2D, texture);
	gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
	gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, colours);
	const pen = byId('colours').getContext('2d');
	for (let i = 0; i < 256; ++i) {
		pen.fillStyle = `rgb(${colours.slice(3 * i, 3 * i + 3).join()})`;
		pen.fillRect(0, 255 - i, 1, 1);
	}
	byId('label').textContent = `${field.label} [${field.unit}]`;
	byId('unit').textContent = field.unit;
	[byId('low').value, byId('high').value] = [field.low, field.high].map(x => +(x / field.size).toPrecision(6));
	[byId('bottom').textContent, byId('top').textContent] = [field.low, field.high].map(x => short(x / field.size));
	showFrame();
}

function rangeGiven() {
	const field = data.fields[state.field], [from, to] = ['low', 'high'].map(id => field.size * byId(id).valueAsNumber);
	if (!(from < to)) return;
	[field.low, field.high] = [from, to];
	[byId('bottom').textContent, byId('top').textContent] = [from, to].map(x => short(x / field.size));
	draw();
}

// ---- what the mouse does
function turn(dx, dy) { // the axis upwards stays upright in 3D
	const rotate = (v, axis, angle) => {
		const c = Math.cos(angle), s = Math.sin(angle), k = cross(axis, v), d = dot(axis, v) * (1 - c);
		return v.map((x, i) => x * c + k[i] * s + axis[i] * d);
	};
	const axis = [0, 0, 0];
	axis[up] = state.upwards[up] < 0 ? -1 : 1;
	for (const [about, angle] of [[axis, -dx / 150], [state.right, -dy / 150]]) {
		state.right = unit(rotate(state.right, about, angle));
		state.upwards = unit(rotate(state.upwards, about, angle));
	}
}

function move(dx, dy) {
	const perPixel = 2 * state.zoom / gl.canvas.clientHeight;
	state.middle = state.middle.map((x, i) => x - perPixel * (dx * state.right[i] - dy * state.upwards[i]));
}

function pick(event) {
	const ratio = gl.canvas.width / gl.canvas.clientWidth, found = new Uint8Array(4);
	draw(true);
	gl.readPixels(event.offsetX * ratio, gl.canvas.height - event.offsetY * ratio, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, found);
	draw();
	return tell(found[3] ? found[0] + 256 * found[1] + 65536 * found[2] : 0);
}

function tell(number) { // of a point, by its row
	const frame = data.frames[state.frame], row = number - 1;
	byId('point').textContent = row < 0 ? '' : `point at ${pointOf(frame, row).centre.slice(0, data.dim).map(short).join(', ')} m\n` +
		data.fields.map((field, i) => `${field.label}: ${short(valueOf(frame, row, i) / field.size)} ${field.unit}`).join('\n');
	return row;
}

function listen() {
	const canvas = gl.canvas;
	let from = null, moved = 0;
	canvas.onpointerdown = event => { from = event; moved = 0; canvas.setPointerCapture(event.pointerId); };
	canvas.onpointerup = event => { from = null; if (moved < 4) pick(event); };
	canvas.onpointermove = event => {
		if (!from) return;
		const way = [event.clientX - from.clientX, event.clientY - from.clientY];
		moved += Math.abs(way[0]) + Math.abs(way[1]);
		(event.shiftKey || event.buttons === 2 || flat && !event.altKey ? move : turn)(...way);
		from = event;
		draw();
	};
	canvas.oncontextmenu = event => event.preventDefault();
	canvas.onwheel = event => { event.preventDefault(); state.zoom *= Math.exp(event.deltaY / 800); draw(); };
	byId('field').onchange = () => { state.field = byId('field').selectedIndex; showField(); };
	byId('frame').oninput = () => { state.frame = byId('frame').valueAsNumber; showFrame(); };
	byId('low').onchange = byId('high').onchange = rangeGiven;
	for (const id of ['axis', 'at', 'other', 'bodies', 'edges']) byId(id).oninput = () => draw();
	byId('home').onclick = () => { home(); draw(); };
	byId('play').onclick = play;
	new ResizeObserver(resize).observe(byId('scene'));
}

function play() {
	state.playing = !state.playing;
	byId('play').textContent = state.playing ? 'stop' : 'play';
	const next = () => {
		if (!state.playing) return;
		state.frame = (state.frame + 1) % data.frames.length;
		showFrame();
		setTimeout(next, 1000 / data.fps);
	};
	next();
}

function resize() {
	const ratio = window.devicePixelRatio || 1, canvas = gl.canvas;
	canvas.width = Math.max(1, canvas.clientWidth * ratio);
	canvas.height = Math.max(1, canvas.clientHeight * ratio);
	if (shapes) draw();
}

// What stands behind the # of the address: frame=3&field=stress_xy&cut=y:0.5&turn=30:-10&play
function fromAddress() {
	const given = new URLSearchParams(location.hash.slice(1));
	state.frame = Math.min(data.frames.length - 1, Math.max(0, +(given.get('frame') ?? data.frames.length - 1)));
	state.field = Math.max(0, data.fields.findIndex(field => field.name === given.get('field')));
	byId('field').selectedIndex = state.field;
	const [axis, at] = (given.get('cut') ?? ':').split(':');
	if ('xyz'.includes(axis) && axis) [byId('axis').value, byId('at').value] = ['xyz'.indexOf(axis), at];
	if (given.has('turn')) turn(...given.get('turn').split(':').map(degrees => degrees * 150 * Math.PI / 180));
	if (given.has('play')) play();
}

// For tests: how much of the picture is drawn, and what is in its middle.
function countDrawn() {
	const { width, height } = gl.canvas, pixels = new Uint8Array(4 * width * height);
	gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
	let drawn = 0;
	for (let i = 0; i < pixels.length; i += 4) drawn += pixels[i] + pixels[i + 1] + pixels[i + 2] < 765;
	return drawn / (width * height);
}

async function begin() {
	if (!gl) throw Error('this browser has no WebGL 2');
	await unpackFrames();
	makeShapes();
	for (const field of data.fields) byId('field').add(new Option(field.name));
	byId('frame').max = data.frames.length - 1;
	if (flat) { byId('axis').remove(3); byId('point').textContent = byId('point').textContent.replace('turn; with shift or the right button: move', 'move; with alt: turn'); }
	resize();
	home();
	listen();
	fromAddress();
	showField();
	if (state.playing) await new Promise(done => setTimeout(done, 1500 / data.fps)); // so that what is told is of a run that plays
	const { clientWidth, clientHeight } = gl.canvas, hint = byId('point').textContent;
	document.body.dataset.ready = JSON.stringify({ frames: data.frames.length, frame: state.frame, points: rows(data.frames[state.frame]), drawn: countDrawn(), middle: pick({ offsetX: clientWidth / 2, offsetY: clientHeight / 2 }), said: byId('point').textContent });
	byId('point').textContent = hint;
}

begin().catch(error => { document.body.innerHTML = '<div id="failure"></div>'; byId('failure').textContent = `This view cannot be shown: ${error.message}`; });
