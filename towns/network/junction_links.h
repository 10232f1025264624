// Private to the room: elements of the document are handed around.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace reprise::towns {

/// One way through a junction, or over a crossing of it.
struct JunctionLink {
    std::size_t index = 0;  ///< in its junction's rows
    pugi::xml_node xml;     ///< <connection>
    std::string_view from, to, lane;
    bool walks = false;  ///< over a crossing
};

/// The links of a network (.net.xml), as SUMO numbers them. The network must outlive this.
class JunctionLinks {
  public:
    explicit JunctionLinks(pugi::xml_node net);

    /// Lane by lane into the junction; walkers on crossings count, and are left out.
    std::vector<JunctionLink> through(pugi::xml_node junction) const;

    /// As above, with the crossings.
    std::vector<JunctionLink> through_and_over(pugi::xml_node junction) const;

    /// Those from a lane, named as "edge_index".
    const std::vector<pugi::xml_node>& from(std::string_view lane) const;

  private:
    std::string_view function(pugi::xml_node link, const char* end) const;

    std::map<std::string_view, std::string_view> functions_;  ///< [edge]
    std::map<std::string, std::vector<pugi::xml_node>, std::less<>> links_;
};

/// Who gives way to whom at a junction: a row for each of its links, and in it a bit for each, the
/// first link rightmost. What is written through this is written into the network.
class JunctionRows {
  public:
    explicit JunctionRows(pugi::xml_node junction);

    bool are_foes(std::size_t one, std::size_t other) const;
    bool gives_way(std::size_t one, std::size_t other) const;

    /// To how many links one gives way.
    std::size_t given_way(std::size_t index) const;

    void goes_before(std::size_t one, std::size_t other);

    /// Neither gives way to the other one, nor are they foes.
    void part(std::size_t one, std::size_t other);

  private:
    bool has(std::size_t index, const char* name, std::size_t bit) const;
    void clear(std::size_t index, const char* name, std::size_t bit);

    std::vector<pugi::xml_node> requests_;
};

}  // namespace reprise::towns
