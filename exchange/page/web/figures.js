'use strict';
// How each kind of actor looks from above, in its own frame: metres, x ahead, y left. `here` is a place as Trace.place makes it.

const ACTOR_COLOURS = {
  light: { traffic: ['#3f4a57', '#5a6672', '#2e3a49', '#73808c', '#4a4f55', '#55616a'], parked: '#7b858f', walker: '#7a3fa0', bicycle: '#0b7285', prop: '#f76707', liveries: ['', '#d9a400', '#1c5fb8', '#d4373e'], glass: '#dfe9f2',
    edge: '#ffffffb0', label: '#ffffffe8', text: '#1c2127', chosen: '#e8572a', wheel: '#15181b', head: '#2b1d14a0' },
  dark: { traffic: ['#aeb9c4', '#93a0ac', '#c6ced6', '#7f8c99', '#a3a9b0', '#b9bfc6'], parked: '#79838d', walker: '#c792ea', bicycle: '#4cc9d8', prop: '#ff922b', liveries: ['', '#f2c230', '#5b9cf0', '#ff7a7f'], glass: '#20272e',
    edge: '#00000080', label: '#14171ae0', text: '#e8ebee', chosen: '#ff8a5c', wheel: '#0b0d0f', head: '#00000090' },
};
const LAMP = { brake: 1, left: 2, right: 4, beam: 8, reverse: 16 }; // world/models/catalogue.h

/** Low beams: two soft cones. */
function drawBeams(context, view, here, theme) {
  if (!(here.lamps & LAMP.beam) || here.track.kind === 'walker' || here.track.kind === 'prop') return;
  const { length, rear, width } = here.track.shape;
  context.save();
  const [left, top] = view.toScreen(here.x, here.y);
  context.translate(left, top);
  context.rotate(-here.yaw);
  context.scale(view.scale, -view.scale);
  const front = length - rear;
  const reach = 14;
  const light = context.createLinearGradient(front, 0, front + reach, 0);
  light.addColorStop(0, theme === 'dark' ? '#ffe9a870' : '#fff3c478');
  light.addColorStop(1, '#fff3c400');
  context.fillStyle = light;
  context.beginPath();
  context.moveTo(front, width * 0.4);
  context.lineTo(front + reach, width * 0.4 + 2.6);
  context.lineTo(front + reach, -width * 0.4 - 2.6);
  context.lineTo(front, -width * 0.4);
  context.fill();
  context.restore();
}

function drawVehicle(context, view, here, theme, seconds, paint) {
  const { track } = here;
  const { length, width, rear } = track.shape;
  const colours = ACTOR_COLOURS[theme];
      // In a view of a whole town a car is finer than a pixel: it stays to be seen.
  const grown = Math.max(1, (track.isCast ? 10 : 6.5) / (view.scale * length));
  if (grown > 1) context.scale(grown, grown * (grown > 1.5 ? 1.3 : 1));
  const fine = view.scale > 4;
  if (track.isTwoWheeler) return drawTwoWheeler(context, track, paint, colours, view);
  if (fine) drawWheels(context, here, colours);
  context.beginPath();
  const round = Math.min(width * 0.3, track.shape.body >= 3 && track.shape.body <= 5 ? 0.25 : 0.6);
  context.roundRect(-rear, -width / 2, length, width, round);
  context.fillStyle = paint;
  context.fill();
  context.lineWidth = Math.max(0.06 / grown, 0.8 / (view.scale * grown));
  context.strokeStyle = colours.edge;
  if (view.scale > 1) context.stroke();
  if (view.scale < 2.2) return;
  drawGlass(context, track, colours);
  if (fine) drawLamps(context, here, seconds);
  if (here.lamps >> 16) drawDoors(context, here, paint);
}

/** Those that stand open, as Door counts them (world/tick.fbs). */
function drawDoors(context, { track: { shape }, lamps }, paint) {
  const { length, width, rear } = shape;
  context.strokeStyle = paint;
  context.lineWidth = 0.14;
  for (let door = 0; door < 4; ++door) {
    if (!(lamps & (1 << (16 + door)))) continue;
    const side = door % 2 === 0 ? 1 : -1;
    const hinge = length * (door < 2 ? 0.68 : 0.46) - rear;
    context.beginPath();
    context.moveTo(hinge, (side * width) / 2);
    context.lineTo(hinge - 0.35, side * (width / 2 + 0.95));
    context.stroke();
  }
}

function drawGlass(context, { shape: { length, width, rear, body } }, colours) {
  context.fillStyle = colours.glass;
  context.globalAlpha = 0.82;
  const pane = (from, to, front, back) => {
    context.beginPath();
    context.moveTo(from * length - rear, back * width);
    context.lineTo(to * length - rear, front * width);
    context.lineTo(to * length - rear, -front * width);
    context.lineTo(from * length - rear, -back * width);
    context.fill();
  };
  const isBox = body === 3 || body === 4 || body === 5 || body === 9; // van, lorry, bus, minibus
  if (isBox) {
    pane(0.86, 0.95, 0.4, 0.43);
  } else {
    pane(0.6, 0.73, 0.4, 0.36);
    pane(0.2, 0.12, 0.38, 0.34);
  }
  context.globalAlpha = 1;
}

function drawWheels(context, { track, steer }, colours) {
  const { wheelbase, width } = track.shape;
  context.fillStyle = colours.wheel;
  for (const [x, angle] of [[0, 0], [wheelbase, steer]])
    for (const side of [-1, 1]) {
      context.save();
      context.translate(x, side * (width / 2 - 0.1));
      context.rotate(angle);
      context.fillRect(-0.32, -0.13, 0.64, 0.26);
      context.restore();
    }
}

function drawLamps(context, { track, lamps }, seconds) {
  const { length, width, rear } = track.shape;
  const lamp = (x, side, colour) => {
    context.fillStyle = colour;
    context.fillRect(x - 0.14, side * (width / 2 - 0.3) - 0.22, 0.28, 0.44);
  };
  const front = length - rear - 0.1;
  const blinks = (seconds * 1.5) % 1 < 0.5;
  for (const side of [-1, 1]) {
    lamp(front, side, lamps & LAMP.beam ? '#fff6c9' : '#ffffff80');
    lamp(-rear + 0.1, side, lamps & LAMP.brake ? '#ff1f1f' : lamps & LAMP.reverse ? '#ffffff' : '#8f1d1d');
    const turning = lamps & (side > 0 ? LAMP.left : LAMP.right);
    if (turning && blinks) {
      lamp(front - 0.15, side * 1.08, '#ffa51f');
      lamp(-rear + 0.25, side * 1.08, '#ffa51f');
    }
  }
}

function drawTwoWheeler(context, { shape: { length, width, rear } }, paint, colours, view) {
  context.fillStyle = colours.wheel;
  context.fillRect(-rear, -0.09, length, 0.18);
  context.fillStyle = paint;
  context.beginPath();
  context.ellipse(length / 2 - rear - 0.1, 0, length * 0.2, width * 0.45, 0, 0, 7);
  context.fill();
  context.lineWidth = Math.max(0.04, 0.7 / view.scale);
  context.strokeStyle = colours.edge;
  context.stroke();
  context.fillRect(length - rear - 0.55, -width * 0.45, 0.1, width * 0.9);
}

/** By PropForm (world/models/prop_models.h): cones and tyres are round. */
function drawProp(context, view, { track: { shape } }, theme) {
  const { length, width, form } = shape;
  const grown = Math.max(1, 5 / (view.scale * Math.max(length, width)));
  context.scale(grown, grown);
  context.beginPath();
  if (form === 1 || form === 5) context.ellipse(0, 0, length / 2, width / 2, 0, 0, 7);
  else context.rect(-length / 2, -width / 2, length, width);
  context.fillStyle = shape.paint || ACTOR_COLOURS[theme].prop;
  context.fill();
  context.lineWidth = 1 / (view.scale * grown);
  context.strokeStyle = ACTOR_COLOURS[theme].edge;
  context.stroke();
  if (form !== 1) return;
  context.beginPath();
  context.arc(0, 0, Math.min(length, width) * 0.2, 0, 7);
  context.fillStyle = '#ffffff';
  context.fill();
}

function drawWalker(context, view, here, theme, paint) {
  const { shape, isCast } = here.track;
  const colours = ACTOR_COLOURS[theme];
  const grown = Math.max(1, (isCast ? 9 : 5) / (view.scale * shape.width));
  context.scale(grown, grown);
  const isDown = here.lamps & 1;
  context.fillStyle = paint;
  context.beginPath();
  context.ellipse(0, 0, isDown ? 0.85 : shape.length * 0.75, shape.width / 2, 0, 0, 7);
  context.fill();
  context.lineWidth = Math.max(0.03, 1 / (view.scale * grown));
  context.strokeStyle = isDown ? '#f03e3e' : colours.edge;
  context.stroke();
  context.fillStyle = colours.head;
  context.beginPath();
  context.arc(isDown ? 0.95 : 0.03, 0, Math.min(0.12, shape.width * 0.27), 0, 7);
  context.fill();
}
