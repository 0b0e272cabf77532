// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/solid_file.h"

#include <cstring>
#include <fstream>

#include "surfaces/checksum.h"
#include "tautline/error.h"

namespace tautline {
namespace {

constexpr std::string_view kMagic = "TautSld\n";
constexpr std::uint32_t kVersion = 1, kByteOrder = 0x01020304;

/** Everything of a grid that has a fixed length, in the order of the file. */
template <class Grid, class Function>
void visitNumbers(Grid& grid, Function&& visit) {
    for (int i = 0; i < 3; ++i) visit(grid.origin[i]);
    visit(grid.spacing);
    for (int i = 0; i < 3; ++i) visit(grid.farOrigin[i]);
    for (auto* number : {&grid.farSpacing, &grid.blendBegin, &grid.blendEnd, &grid.size, &grid.width}) visit(*number);
    for (auto& count : grid.numBricks) visit(count);
    for (auto& count : grid.numFarControls) visit(count);
}

template <class Grid, class Function>
void visitArrays(Grid& grid, Function&& visit) {
    visit(grid.bricks);
    visit(grid.controls);
    visit(grid.farControls);
}

class Writer {
public:
    template <class Number>
    void add(const Number& number) {
        m_bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    }
    template <class Number>
    void addAll(const std::vector<Number>& numbers) {
        m_bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    }
    std::string& updBytes() { return m_bytes; }

private:
    std::string m_bytes;
};

class Reader {
public:
    Reader(std::string_view bytes, const std::string& fileName) : m_bytes(bytes), m_fileName(fileName) {}

    template <class... Parts>
    void check(bool holds, const Parts&... parts) const {
        require(holds, m_fileName, ": ", parts...);
    }
    template <class Number>
    Number take() {
        Number number;
        take(&number, 1);
        return number;
    }
    template <class Number>
    void take(Number* numbers, std::uint64_t count) {
        check(count <= (m_bytes.size() - m_at) / sizeof(Number), "cut off: at byte ", m_at, " it needs ", count,
              " numbers of ", sizeof(Number), " bytes, and has ", m_bytes.size() - m_at, " bytes");
        if (count > 0) std::memcpy(numbers, m_bytes.data() + m_at, count * sizeof(Number));
        m_at += count * sizeof(Number);
    }
    /** So that no file makes us ask for more memory than it has bytes. */
    template <class Number>
    void takeAll(std::vector<Number>& numbers, std::uint64_t count) {
        check(count <= m_bytes.size() / sizeof(Number), "cut off: it should have ", count, " numbers of ",
              sizeof(Number), " bytes, and is ", m_bytes.size(), " bytes long");
        numbers.resize(count);
        take(numbers.data(), count);
    }
    void checkHeader() {
        check(m_bytes.substr(0, kMagic.size()) == kMagic, "no file of a solid");
        m_at = kMagic.size();
        const auto version = take<std::uint32_t>(), order = take<std::uint32_t>();
        check(order == kByteOrder, "written on a machine of another byte order");
        check(version == kVersion, "of version ", version, ", where this program reads version ", kVersion,
              ": fit the mesh again");
        const auto length = take<std::uint64_t>();
        check(length == m_bytes.size(), "should be ", length, " bytes long, but is ", m_bytes.size());
        check(m_bytes.size() >= m_at + sizeof(std::uint64_t), "cut off after its header");
        const std::size_t end = m_bytes.size() - sizeof(std::uint64_t);
        std::uint64_t sum;
        std::memcpy(&sum, m_bytes.data() + end, sizeof(sum));
        check(calcChecksum(m_bytes.substr(0, end)) == sum, "damaged: its checksum is wrong");
    }
    bool isAtChecksum() const { return m_at + sizeof(std::uint64_t) == m_bytes.size(); }

private:
    std::string_view m_bytes;
    const std::string& m_fileName;
    std::size_t m_at = 0;
};

}  // namespace

std::string encodeSolid(const BSplineSolid& solid) {
    const SolidGrid& grid = solid.getGrid();
    Writer writer;
    writer.updBytes() = kMagic;
    writer.add(kVersion);
    writer.add(kByteOrder);
    const std::size_t lengthAt = writer.updBytes().size();
    writer.add(std::uint64_t(0));
    visitNumbers(grid, [&](const auto& number) { writer.add(number); });
    visitArrays(grid, [&](const auto& numbers) { writer.add(std::uint64_t(numbers.size())); });
    visitArrays(grid, [&](const auto& numbers) { writer.addAll(numbers); });
    std::string& bytes = writer.updBytes();
    const std::uint64_t length = bytes.size() + sizeof(std::uint64_t);
    std::memcpy(bytes.data() + lengthAt, &length, sizeof(length));
    writer.add(calcChecksum(bytes));
    return std::move(bytes);
}

BSplineSolid decodeSolid(std::string_view bytes, const std::string& fileName) {
    Reader reader(bytes, fileName);
    reader.checkHeader();
    SolidGrid grid;
    visitNumbers(grid, [&](auto& number) { reader.take(&number, 1); });
    std::vector<std::uint64_t> lengths;
    visitArrays(grid, [&](const auto&) { lengths.push_back(reader.take<std::uint64_t>()); });
    std::size_t at = 0;
    visitArrays(grid, [&](auto& numbers) { reader.takeAll(numbers, lengths[at++]); });
    reader.check(reader.isAtChecksum(), "has more bytes than its numbers");
    try {
        return BSplineSolid(std::move(grid));
    } catch (const InvalidInput& error) {
        throw InvalidInput(fileName + ": " + error.what());
    }
}

void writeSolidFile(const BSplineSolid& solid, const std::filesystem::path& file) {
    const std::string bytes = encodeSolid(solid);
    std::ofstream stream(file, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    require(!stream.fail(), file.string(), ": the file cannot be written");
}

BSplineSolid readSolidFile(const std::filesystem::path& file) {
    std::error_code error;
    const auto length = std::filesystem::file_size(file, error);
    require(!error, file.string(), ": the file cannot be read");
    std::string bytes(length, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(bytes.data(), static_cast<std::streamsize>(length));
    require(bool(stream), file.string(), ": the file cannot be read");
    return decodeSolid(bytes, file.string());
}

}  // namespace tautline
