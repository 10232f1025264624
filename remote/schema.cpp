#include "remote/schema.h"

#include "wire_digest.h"

namespace reprise::remote {

std::string_view schema_digest() {
    return REPRISE_WIRE_DIGEST;
}

}  // namespace reprise::remote
