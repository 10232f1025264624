// Private to the room: OpenStreetMap's files through libosmium.
#pragma once

#include <filesystem>

#include <osmium/io/xml_input.hpp>
#include <osmium/thread/pool.hpp>

namespace reprise::towns {

/// Calls `take` with each object of one kind, in the order of the file.
template <typename Object, typename Take>
void for_each_object(const std::filesystem::path& map,
                     osmium::osm_entity_bits::type kind,
                     Take&& take) {
    // XML is parsed without a pool. Without one of our own, the reader would start one that lives
    // as long as the process; its other threads end with it.
    osmium::thread::Pool pool(1);
    osmium::io::Reader reader(
        osmium::io::File(map.string(), "xml"), kind, osmium::io::read_meta::no, pool);
    while (const osmium::memory::Buffer buffer = reader.read())
        for (const Object& object : buffer.select<Object>())
            take(object);
    reader.close();
}

}  // namespace reprise::towns
