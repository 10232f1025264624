// Reads `reprise export --to foxglove` with MCAP's own reader: every message must be what its
// embedded schema says, field by field, and show the trace: as `reprise cat` prints it.
//   node read_foxglove.mjs PATH_OF_REPRISE TRACE EXPORTED PICTURES
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { open } from "node:fs/promises";
import assert from "node:assert/strict";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const [reprise, trace, exported, pictures] = process.argv.slice(2);

/// As far as Foxglove's schemas go. Stricter than they are: no field may lack, none may be unknown.
function validate(value, schema, path) {
  if (schema.oneOf) {
    assert.ok(schema.oneOf.some((one) => one.const === value), `${path}: ${value}`);
  } else if (schema.type === "object") {
    assert.deepEqual(Object.keys(value).sort(), Object.keys(schema.properties).sort(), path);
    for (const [key, of] of Object.entries(schema.properties)) validate(value[key], of, `${path}.${key}`);
  } else if (schema.type === "array") {
    assert.ok(Array.isArray(value), path);
    value.forEach((item, i) => validate(item, schema.items, `${path}[${i}]`));
  } else if (schema.type === "integer") {
    assert.ok(Number.isInteger(value) && value >= (schema.minimum ?? -Infinity), `${path}: ${value}`);
    assert.ok(value <= (schema.maximum ?? Infinity), `${path}: ${value}`);
  } else {
    assert.equal(typeof value, schema.type, path);
  }
}

/// A vector turned by a unit quaternion.
function turned({ x, y, z, w }, [a, b, c]) {
  const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2], c + w * t[2] + x * t[1] - y * t[0]];
}

function near(found, expected, where) {
  for (const axis of ["x", "y", "z"]) assert.ok(Math.abs(found[axis] - expected[axis]) < 1e-6, where);
}

const said = new Map(); // by tick: both streams in one
for (const text of execFileSync(reprise, ["cat", trace], { maxBuffer: 2 ** 30 }).toString().trim().split("\n")) {
  const line = JSON.parse(text);
  said.set(line.tick, { ...said.get(line.tick), ...line });
}

const file = await open(exported);
const reader = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(file),
  decompressHandlers: await loadDecompressHandlers(),
});
const counts = {};
const logged = [];
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  assert.equal(channel.messageEncoding, "json");
  assert.equal(schema.encoding, "jsonschema");
  const shown = JSON.parse(new TextDecoder().decode(message.data));
  const definition = JSON.parse(new TextDecoder().decode(schema.data));
  assert.equal(definition.title, schema.name);
  const where = `${channel.topic} at ${message.logTime}`;
  validate(shown, definition, where);
  counts[channel.topic] = (counts[channel.topic] ?? 0) + 1;

  const tick = said.get(String(message.sequence));
  const name = String(message.sequence).padStart(6, "0");
  assert.equal(BigInt(Math.round(tick.time * 1e9)), message.logTime);
  if (channel.topic === "/tf") {
    assert.equal(shown.transforms.length, tick.vehicles.length, where);
    shown.transforms.forEach((frame, i) => {
      assert.deepEqual(frame.translation, tick.vehicles[i].position, where);
      assert.deepEqual(frame.rotation, tick.vehicles[i].orientation, where);
    });
  } else if (channel.topic === "/actors") {
    const of = (id) => shown.entities.find((entity) => entity.id === id);
    assert.equal(of("cars").cubes.length, tick.cars.length, where);
    assert.equal(of("walkers").cylinders.length, tick.walkers.length, where);
    assert.ok(of("ego"), where);
    tick.cars.forEach((car, i) => {
      const { position } = of("cars").cubes[i].pose;
      // The box's middle lies ahead of the rear axle, within half a lorry.
      const ahead = [position.x - car.position.x, position.y - car.position.y];
      const along = ahead[0] * Math.cos(car.yaw) + ahead[1] * Math.sin(car.yaw);
      const beside = ahead[1] * Math.cos(car.yaw) - ahead[0] * Math.sin(car.yaw);
      assert.ok(along > 0.5 && along < 6 && Math.abs(beside) < 1e-4, where);
    });
  } else if (channel.topic === "/log") {
    logged.push(shown.message);
  } else if (channel.topic === "/camera") {
    assert.ok(Buffer.from(shown.data, "base64").equals(readFileSync(`${pictures}/${name}.png`)), where);
  } else if (channel.topic.startsWith("/points/")) {
    const file = readFileSync(`${pictures}/${channel.topic.slice("/points/".length)}/${name}.ply`);
    const head = file.toString("latin1", 0, file.indexOf("end_header\n") + "end_header\n".length);
    assert.ok(Buffer.from(shown.data, "base64").equals(file.subarray(head.length)), where);
    assert.equal(shown.data.length === 0 ? 0 : Buffer.from(shown.data, "base64").length / shown.point_stride, Number(head.match(/vertex (\d+)/)[1]));
    const properties = [...head.matchAll(/property (\w+) (\w+)/g)];
    assert.deepEqual(shown.fields, properties.map((one, i) => ({ name: one[2], offset: 4 * i, type: one[1] === "uint" ? 5 : 7 })));
    // Where the sensor was: by the first vehicle's pose and what the command said.
    const { position, orientation } = tick.vehicles[0];
    const along = turned(orientation, [1, 0.2, 1.6]);
    near(shown.pose.position, { x: position.x + along[0], y: position.y + along[1], z: position.z + along[2] }, where);
    const [yaw, pitch] = [Math.PI / 9, -Math.PI / 36];
    const ahead = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
    const [x, y, z] = turned(orientation, ahead);
    const [a, b, c] = turned(shown.pose.orientation, [1, 0, 0]);
    near({ x: a, y: b, z: c }, { x, y, z }, where);
    assert.equal(shown.frame_id, "world");
  }
}
await file.close();

const printed = [...said.values()].flatMap((tick) => tick.events).filter((event) => event.kind === "printed");
for (const event of printed) assert.ok(logged.includes(event.text), event.text);
assert.ok(printed.length > 0);
assert.equal(counts["/town"], 1);
assert.equal(counts["/tf"], Math.ceil(said.size / 2));
assert.equal(counts["/actors"], counts["/tf"]);
assert.ok(counts["/camera"] > 0);
assert.equal(counts["/points/lidar"], counts["/camera"]);
assert.equal(counts["/points/radar"], counts["/camera"]);
console.log(`every message is as its schema says and shows the trace: ${JSON.stringify(counts)}`);
