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
    const name = `${String(message.sequence).padStart(6, "0")}.png`;
    assert.ok(Buffer.from(shown.data, "base64").equals(readFileSync(`${pictures}/${name}`)), where);
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
console.log(`every message is as its schema says and shows the trace: ${JSON.stringify(counts)}`);
