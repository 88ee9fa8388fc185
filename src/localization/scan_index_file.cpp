// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// An index as a file: the arrays of all that it has, in the order of its making.

#include "localization/scan_index_data.h"
#include "scan/scan_file.h"
#include "scan/scan_view.h"
#include "support/archive.h"
#include "support/mapped_file.h"

#include <system_error>

namespace pcl_flashreg {
namespace {

constexpr std::string_view MAGIC = "flindex\n";
constexpr std::uint32_t VERSION = 1;

template <typename Value>
void
addArray(ArchiveWriter& out, const Array<Value>& values, std::size_t width)
{
  out.add(values.data(), values.size(), width);
}

template <typename Value>
void
mapArray(ArchiveReader& in, Array<Value>& values, std::size_t width)
{
  std::size_t count = 0;
  const Value* const data = in.next<Value>(count, width);
  values.map(in.keeper(), data, count);
}

/** \brief A few numbers, of which there must be as many as were written. */
std::vector<double>
nextNumbers(ArchiveReader& in, std::size_t count)
{
  std::vector<double> numbers = in.nextCopy<double>();
  if (numbers.size() != count)
    throw ArchiveError("is damaged: numbers are missing");
  return numbers;
}

void
require(bool sound)
{
  if (!sound)
    throw ArchiveError("is damaged: it holds numbers that no index has");
}

void
addScan(ArchiveWriter& out, const Scan& scan)
{
  const std::string bytes = scan.serialize();
  out.add(bytes.data(), bytes.size());
}

Scan
nextScan(ArchiveReader& in)
{
  std::size_t size = 0;
  const char* const bytes = in.next<char>(size);
  return mapScan({bytes, size}, in.keeper());
}

void
addFeatures(ArchiveWriter& out, const FeatureIndex& index)
{
  const auto& [features, space, tree, blocks] = index;
  out.add(features.finite);
  out.add(features.equal.firsts());
  out.add(features.equal.followers());
  const double numbers[] = {
      space.scale(), static_cast<double>(features.largest), blocks.longest()};
  out.add(numbers, 3);
  out.add(space.mean().data(), static_cast<std::size_t>(space.mean().size()));
  out.add(space.components().data(),
          static_cast<std::size_t>(space.components().size()));
  out.add(tree.order);
  out.add(tree.boxes.data(), tree.boxes.size(), sizeof(float));
  const cpu::FeatureBlock input = blocks.input();
  const std::size_t padded = blocks.blocks() * cpu::FEATURE_BLOCK;
  out.add(input.targets, padded * input.dimension);
  out.add(input.target_norms, padded);
}

template <typename Index>
bool
allBelow(const std::vector<Index>& numbers, std::size_t limit)
{
  for (const Index number : numbers)
    if (static_cast<std::size_t>(number) >= limit)
      return false;
  return true;
}

detail::EqualRows
nextEqualRows(ArchiveReader& in, std::size_t count)
{
  std::vector<std::uint32_t> firsts = in.nextCopy<std::uint32_t>();
  std::vector<std::uint32_t> followers = in.nextCopy<std::uint32_t>();
  require(!firsts.empty() && allBelow(firsts, count));
  require(followers.empty() || followers.size() == count);
  // Each follows one before it, so that no chain comes back.
  for (std::size_t i = 0; i < followers.size(); ++i)
    require(followers[i] == detail::EqualRows::NONE ||
            (followers[i] > i && followers[i] < count));
  return {std::move(firsts), std::move(followers)};
}

FeatureIndex
nextFeatures(ArchiveReader& in, const FeatureView& view)
{
  std::vector<std::int32_t> finite = in.nextCopy<std::int32_t>();
  require(allBelow(finite, view.size));
  detail::EqualRows equal = nextEqualRows(in, finite.size());
  const std::vector<double> numbers = nextNumbers(in, 3);
  DistinctFeatures features(
      view, std::move(finite), std::move(equal), static_cast<float>(numbers[1]));

  const auto dimension = static_cast<Eigen::Index>(view.dimension);
  const std::vector<double> mean = nextNumbers(in, view.dimension);
  const Eigen::Index columns = std::min<Eigen::Index>(dimension, SHADOW_COMPONENTS);
  const std::vector<double> components =
      nextNumbers(in, static_cast<std::size_t>(dimension * columns));
  FeatureSpace space(
      Eigen::Map<const Eigen::RowVectorXd>(mean.data(), dimension),
      Eigen::Map<const Eigen::MatrixXd>(components.data(), dimension, columns),
      numbers[0]);

  FeatureTree tree;
  tree.order = in.nextCopy<std::int32_t>();
  tree.boxes = in.nextCopy<ShadowBox>(sizeof(float));
  const std::size_t blocks =
      (features.size() + cpu::FEATURE_BLOCK - 1) / cpu::FEATURE_BLOCK;
  require(tree.order.size() == features.size() &&
          allBelow(tree.order, features.size()) && tree.boxes.size() == 2 * blocks - 1);

  std::size_t values = 0, norms = 0;
  const float* const targets = in.next<float>(values);
  const float* const target_norms = in.next<float>(norms);
  require(norms == blocks * cpu::FEATURE_BLOCK && values == norms * view.dimension);
  TargetBlocks transposed(
      in.keeper(), targets, target_norms, blocks, view.dimension, numbers[2]);
  return {
      std::move(features), std::move(space), std::move(tree), std::move(transposed)};
}

void
addFeatures(ArchiveWriter& out, const std::optional<FeatureIndex>& index)
{
  const double is_there = index ? 1 : 0;
  out.add(&is_there, 1);
  if (index)
    addFeatures(out, *index);
}

void
nextFeatures(ArchiveReader& in, const Scan& scan, std::optional<FeatureIndex>& index)
{
  if (nextNumbers(in, 1)[0] == 0)
    return;
  require(scan.features().dimension > 0);
  index.emplace(nextFeatures(in, scan.features()));
}

void
addSurface(ArchiveWriter& out, const Surface& surface)
{
  addArray(out, surface.points, sizeof(float));
  addArray(out, surface.normals, sizeof(float));
  addArray(out, surface.keys, sizeof(std::uint64_t));
  const double numbers[] = {static_cast<double>(surface.key_side),
                            static_cast<double>(surface.key_corner.x()),
                            static_cast<double>(surface.key_corner.y()),
                            static_cast<double>(surface.key_corner.z())};
  out.add(numbers, 4);
  const NearestPointGrid& grid = surface.nearest;
  const double side = static_cast<double>(grid.side());
  out.add(&side, 1);
  addArray(out, grid.blocks(), sizeof(std::uint64_t));
  addArray(out, grid.cells(), sizeof(int));
}

void
nextSurface(ArchiveReader& in, ScanIndex::Data& data)
{
  const Scan& scan = data.scan;
  Surface& surface = data.surface;
  mapArray(in, surface.points, sizeof(float));
  mapArray(in, surface.normals, sizeof(float));
  mapArray(in, surface.keys, sizeof(std::uint64_t));
  const std::size_t size = surface.points.size();
  require(surface.normals.size() == size && surface.keys.size() == size);
  const std::vector<double> key = nextNumbers(in, 4);
  surface.key_side = static_cast<float>(key[0]);
  surface.key_corner = Eigen::Map<const Eigen::Vector3d>(&key[1]).cast<float>();
  require(surface.key_side > 0);

  const auto side = static_cast<float>(nextNumbers(in, 1)[0]);
  Array<NearestPointGrid::Block> blocks;
  Array<int> cells;
  mapArray(in, blocks, sizeof(std::uint64_t));
  mapArray(in, cells, sizeof(int));
  require(surface.nearest.restore(side, std::move(blocks), std::move(cells), size));
  const CloudView<float> view = viewOf(scan);
  data.middle = middleOf(view) + shiftOf(scan);
  surface.lookFrom(
      view.viewpoint, data.middle - shiftOf(scan), static_cast<float>(scan.spacing()));
}

ScanIndex
indexFrom(ArchiveReader& in)
{
  const auto data = std::make_shared<ScanIndex::Data>();
  data->scan = nextScan(in);
  data->coarse = nextScan(in);
  nextFeatures(in, data->scan, data->features);
  nextFeatures(in, data->coarse, data->coarse_features);
  if (!data->scan.empty())
    nextSurface(in, *data);
  return ScanIndex(data);
}

} // namespace

void
ScanIndex::save(const std::string& path) const
{
  ArchiveWriter out(MAGIC, VERSION);
  addScan(out, data_->scan);
  addScan(out, data_->coarse);
  addFeatures(out, data_->features);
  addFeatures(out, data_->coarse_features);
  if (!data_->scan.empty())
    addSurface(out, data_->surface);
  try {
    writeWholeFile(path, out.take());
  }
  catch (const std::system_error& error) {
    throw ScanFileError(path + ": cannot be written: " + error.code().message());
  }
}

ScanIndex
ScanIndex::open(const std::string& path, bool verify)
{
  try {
    const auto file = std::make_shared<const MappedFile>(path);
    ArchiveReader in(file->bytes(), file, MAGIC, VERSION, verify);
    return indexFrom(in);
  }
  catch (const std::system_error& error) {
    throw ScanFileError(path + ": cannot be read: " + error.code().message());
  }
  catch (const ArchiveError& error) {
    throw ScanFileError(path + ": " + error.what());
  }
  catch (const ScanFileError& error) {
    throw ScanFileError(path + ": " + error.what());
  }
}

} // namespace pcl_flashreg
