// SPDX-License-Identifier: MIT
#include "report/vtk_file.hpp"

#include <numeric>

#include <vantage/map/impl/plain_stream.hpp>
#include <vantage/map/impl/whole_file.hpp>
#include "report/base64.hpp"
#include "report/bytes.hpp"
#include "report/record_chunk.hpp"

namespace vantage::detail {
namespace {

constexpr int kVtkLevel = 6;

// Packed data in VTK's format: a header with the number of blocks, the block length, the length of a last, shorter
// block (0: none) and the packed length of each block, then the packed data. Header and data are encoded in base64
// separately.
std::string packed_letters(const std::string& bytes) {
  ByteWriter header;
  if (bytes.empty()) {
    header.word(0, 8);
    header.word(0, 8);
    header.word(0, 8);
    return base64(header.bytes());
  }
  const std::string body = deflated(bytes, kVtkLevel);
  header.word(1, 8);
  header.word(bytes.size(), 8);
  header.word(0, 8);
  header.word(body.size(), 8);
  return base64(header.bytes()) + base64(body);
}

std::string data_array(std::string_view type, std::string_view name, int components, const ByteWriter& bytes) {
  PlainStream out;
  out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
      << "\" format=\"binary\">" << packed_letters(bytes.bytes()) << "</DataArray>\n";
  return out.str();
}

void write_file(const std::filesystem::path& file, std::string_view type, std::string_view content) {
  PlainStream out;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
      << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
         "compressor=\"vtkZLibDataCompressor\">\n"
      << content << "</VTKFile>\n";
  write_whole_file(file, out.str());
}

// The connectivity and offsets arrays of cells with these numbers of points.
std::string cell_arrays(std::size_t points, const std::vector<std::int32_t>& lengths) {
  std::vector<std::int32_t> connectivity(points);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  std::vector<std::int32_t> offsets(lengths.size());
  std::partial_sum(lengths.begin(), lengths.end(), offsets.begin());
  return vtk_array("connectivity", connectivity) + vtk_array("offsets", offsets);
}

}  // namespace

std::string vtk_array(std::string_view name, const std::vector<float>& values, int components) {
  ByteWriter bytes;
  for (const float value : values) {
    bytes.small_real(value);
  }
  return data_array("Float32", name, components, bytes);
}

std::string vtk_array(std::string_view name, const std::vector<std::uint8_t>& values) {
  ByteWriter bytes;
  for (const std::uint8_t value : values) {
    bytes.byte(value);
  }
  return data_array("UInt8", name, 1, bytes);
}

std::string vtk_array(std::string_view name, const std::vector<std::int32_t>& values) {
  ByteWriter bytes;
  for (const std::int32_t value : values) {
    bytes.word(static_cast<std::uint32_t>(value), 4);
  }
  return data_array("Int32", name, 1, bytes);
}

void write_vti(const VoxelBox& cells, const VoxelFrame& frame, std::string_view name,
               const std::vector<std::uint8_t>& values, const std::filesystem::path& file) {
  const VoxelIndex n = cells.extent();
  const Eigen::Vector3d origin = frame.corner_of(cells.lo);
  PlainStream out;
  out.precision(17);
  PlainStream extent;
  extent << "0 " << n.x << " 0 " << n.y << " 0 " << n.z;
  out << "<ImageData WholeExtent=\"" << extent.str() << "\" Origin=\"" << origin.x() << ' ' << origin.y() << ' '
      << origin.z() << "\" Spacing=\"" << frame.size_m << ' ' << frame.size_m << ' ' << frame.size_m
      << "\">\n<Piece Extent=\"" << extent.str() << "\">\n<CellData Scalars=\"" << name << "\">\n"
      << vtk_array(name, values) << "</CellData>\n</Piece>\n</ImageData>\n";
  write_file(file, "ImageData", out.str());
}

void write_vtp(const VtkPolyData& data, const std::filesystem::path& file) {
  std::vector<float> coordinates;
  coordinates.reserve(3 * data.points.size());
  for (const Eigen::Vector3d& point : data.points) {
    for (int axis = 0; axis < 3; ++axis) {
      coordinates.push_back(static_cast<float>(point[axis]));
    }
  }
  const bool lines = !data.line_lengths.empty();
  const std::size_t n = data.points.size();
  PlainStream out;
  out << "<PolyData>\n<Piece NumberOfPoints=\"" << n << "\" NumberOfVerts=\"" << (lines ? 0 : n)
      << "\" NumberOfLines=\"" << data.line_lengths.size()
      << "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n"
      << data.point_arrays << "</PointData>\n<CellData>\n"
      << data.line_arrays << "</CellData>\n<Points>\n"
      << vtk_array("Points", coordinates, 3) << "</Points>\n";
  if (lines) {
    out << "<Lines>\n" << cell_arrays(n, data.line_lengths) << "</Lines>\n";
  } else {
    out << "<Verts>\n" << cell_arrays(n, std::vector<std::int32_t>(n, 1)) << "</Verts>\n";
  }
  out << "</Piece>\n</PolyData>\n";
  write_file(file, "PolyData", out.str());
}

void write_pvd(const std::vector<std::pair<std::size_t, std::filesystem::path>>& parts,
               const std::filesystem::path& file) {
  PlainStream out;
  out << "<Collection>\n";
  for (const auto& [time, part] : parts) {
    out << "<DataSet timestep=\"" << time << "\" part=\"0\" file=\""
        << part.lexically_relative(file.parent_path()).generic_string() << "\"/>\n";
  }
  out << "</Collection>\n";
  write_file(file, "Collection", out.str());
}

}  // namespace vantage::detail
