// Reads traces with MCAP's own reader and decodes them by the schemas that lie in them, then asks
// `reprise cat` for the same ticks: two readers that share no code must agree in every value.
//   node read_traces.mjs PATH_OF_REPRISE FOLDER
import { execFileSync } from "node:child_process";
import { createReadStream, readdirSync } from "node:fs";
import { open } from "node:fs/promises";
import { join } from "node:path";
import assert from "node:assert/strict";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";
import { ByteBuffer } from "flatbuffers";
import { BaseType, Parser, Schema, Table } from "flatbuffers_reflection";

const [reprise, folder] = process.argv.slice(2);
const decompressHandlers = await loadDecompressHandlers();

/// Everything in the order of the file, with every checksum verified, attachments included.
async function readAsStream(path) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const counts = {};
  for await (const block of createReadStream(path)) {
    reader.append(block);
    for (let record; (record = reader.nextRecord()); )
      counts[record.type] = (counts[record.type] ?? 0) + 1;
  }
  assert.ok(reader.done(), "the file ends where MCAP says it does");
  return counts;
}

/// A value as `reprise cat` shows it.
class Shower {
  constructor(bfbs) {
    this.schema = Schema.getRootAsSchema(new ByteBuffer(bfbs));
    this.parser = new Parser(this.schema);
    this.root = this.indexOf(this.schema.rootTable().name());
  }
  indexOf(name) {
    for (let i = 0; i < this.schema.objectsLength(); ++i)
      if (this.schema.objects(i).name() === name) return i;
    throw new Error(`no type ${name}`);
  }
  decode(data) {
    const table = Table.getRootTable(new ByteBuffer(data));
    return this.object(this.parser.toObject(table, true), this.root);
  }
  object(value, index) {
    const type = this.schema.objects(index);
    const shown = {};
    for (let i = 0; i < type.fieldsLength(); ++i) {
      const field = type.fields(i);
      const base = field.type().baseType();
      const one = (item) => this.value(item, base === BaseType.Vector ? field.type().element() : base, field.type().index());
      const found = value[field.name()];
      if (base === BaseType.Vector) shown[field.name()] = Array.from(found ?? [], one);
      else shown[field.name()] = found === undefined || found === null ? null : one(found);
    }
    return shown;
  }
  value(item, base, index) {
    if (base === BaseType.Obj) return this.object(item, index);
    if (typeof item === "bigint") return item.toString();
    if (index >= 0 && typeof item === "number") {
      const kind = this.schema.enums(index);
      for (let i = 0; i < kind.valuesLength(); ++i)
        if (Number(kind.values(i).value()) === item) return kind.values(i).name();
    }
    return base === BaseType.Float ? { float: item } : item;
  }
}

/// `said` is JSON of `reprise cat`, `found` what the Shower made of the bytes. A field that is not
/// there, as in traces of inputs only, is null for `cat`, and the default of its type for the Shower.
function compare(said, found, path) {
  if (said === null && (found === 0 || (Array.isArray(found) && found.length === 0))) return;
  if (found !== null && typeof found === "object" && "float" in found) {
    assert.equal(Math.fround(said), found.float, path);
  } else if (Array.isArray(found)) {
    assert.equal(said.length, found.length, `${path}: length`);
    found.forEach((item, i) => compare(said[i], item, `${path}[${i}]`));
  } else if (found !== null && typeof found === "object") {
    assert.deepEqual(Object.keys(said).sort(), Object.keys(found).sort(), path);
    for (const key of Object.keys(found)) compare(said[key], found[key], `${path}.${key}`);
  } else {
    assert.ok(Object.is(said, found), `${path}: ${said} and ${found}`);
  }
}

async function readByIndex(path, file) {
  const readable = new FileHandleReadable(file);
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const showers = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(schema.encoding, "flatbuffer");
    showers.set(channel.id, new Shower(schema.data));
  }
  const said = execFileSync(reprise, ["cat", path], { maxBuffer: 2 ** 30, stdio: ["ignore", "pipe", "ignore"] }).toString().split("\n");
  let count = 0;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const line = JSON.parse(said[count++]);
    const { topic } = reader.channelsById.get(message.channelId);
    assert.equal(line.topic, topic);
    const noun = showers.get(message.channelId).decode(message.data);
    const tick = noun.index ?? noun.tick;
    assert.equal(line.tick, tick);
    assert.equal(BigInt(Math.round(line.time * 1e9)), message.logTime);
    delete noun.index;
    delete noun.tick;
    for (const key of ["topic", "tick", "time"]) delete line[key];
    compare(line, noun, `${path}: tick ${tick}, ${topic}`);
  }
  assert.equal(said.length - 1, count, `${path}: as many lines as messages`);
  return { reader, count };
}

const paths = readdirSync(folder).filter((name) => name.endsWith(".mcap")).sort();
assert.ok(paths.length > 0, `${folder} holds traces`);
for (const name of paths) {
  const path = join(folder, name);
  const file = await open(path);
  const counts = await readAsStream(path);
  const { reader, count } = await readByIndex(path, file);
  assert.equal(counts.Message ?? 0, count, `${path}: the index leads to every message`);
  assert.equal(BigInt(count), reader.statistics.messageCount);
  assert.equal(counts.Attachment, 4);
  assert.equal(counts.Metadata, 2);
  console.log(`${name}: ${count} messages in ${reader.chunkIndexes.length} chunks, every value as reprise cat says`);
  await file.close();
}
