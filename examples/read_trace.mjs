// Reads a trace without Reprise: Node and the packages of tests/node/package.json. No generated code
// is needed: the schemas lie in the trace.
//   cp tests/node/package*.json examples/read_trace.mjs . && npm ci && node read_trace.mjs a.mcap
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";
import { ByteBuffer } from "flatbuffers";
import { Parser, Schema, Table } from "flatbuffers_reflection";

const file = await open(process.argv[2]);
const reader = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(file),
  decompressHandlers: await loadDecompressHandlers(),
});
const decoders = new Map();
for (const channel of reader.channelsById.values()) {
  const schema = Schema.getRootAsSchema(new ByteBuffer(reader.schemasById.get(channel.schemaId).data));
  const parser = new Parser(schema);
  decoders.set(channel.id, (data) => parser.toObject(Table.getRootTable(new ByteBuffer(data)), true));
}

let speed = 0;
for await (const message of reader.readMessages()) {
  const noun = decoders.get(message.channelId)(message.data);
  if (reader.channelsById.get(message.channelId).topic === "/sim/tick") {
    speed = noun.measurements[0]?.speed ?? 0;
  } else if (message.sequence % 20 === 0) {
    const fastest = noun.cars.reduce((most, car) => Math.max(most, car.speed), 0);
    console.log(
      `tick ${noun.tick}: ${speed.toFixed(3)} m/s; the fastest of ${noun.cars.length} cars: ${fastest.toFixed(3)} m/s`,
    );
  }
}
await file.close();
