// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What align() leaves in the output, beside the points, and in getErrorMessage().

#if defined(__GNUC__) && !defined(__clang__)
// Inside PCL and Eigen: reads of four floats that the compiler takes for one too many.
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif

#include "support/foreign_locale.h"

#include <cstring>
#include <numeric>

#include "flash_registration_fixture.h"

using namespace pcl_flashreg;
using namespace pcl_flashreg::made;

namespace {

using Base = pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>;

/** \brief Leaves the output as pcl::Registration makes it. */
class PclAlone : public Base {
  void
  computeTransformation(PointCloudSource&, const Matrix4&) override
  {
  }
};

void
setSensor(Cloud& cloud, const Eigen::Vector3f& origin, const Eigen::Quaternionf& q)
{
  cloud.sensor_origin_ << origin, 0;
  cloud.sensor_orientation_ = q;
}

/** \brief An output that has been something else before. */
Cloud
usedCloud()
{
  Cloud cloud(7, 3);
  cloud.header.frame_id = "elsewhere";
  cloud.header.seq = 99;
  cloud.is_dense = false;
  setSensor(cloud, {9, 8, 7}, Eigen::Quaternionf(0, 1, 0, 0));
  return cloud;
}

void
expectSameDescription(const Cloud& a, const Cloud& b)
{
  EXPECT_EQ(a.size(), b.size());
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.is_dense, b.is_dense);
  EXPECT_EQ(a.header.frame_id, b.header.frame_id);
  EXPECT_EQ(a.header.stamp, b.header.stamp);
  EXPECT_EQ(a.header.seq, b.header.seq);
}

/** \brief The sensor stood there before the pose, or stands there still without one. */
void
expectSensorMoved(const Cloud& source, const Cloud& output, const RigidTransform& pose)
{
  const Eigen::Vector3d origin = source.sensor_origin_.head<3>().cast<double>();
  const Eigen::Vector3d expected = pose.rotation * origin + pose.translation;
  EXPECT_LT((output.sensor_origin_.head<3>().cast<double>() - expected).norm(), 1e-5);
  EXPECT_EQ(output.sensor_origin_[3], source.sensor_origin_[3]);
  const Eigen::Matrix3d orientation =
      pose.rotation * source.sensor_orientation_.cast<double>().toRotationMatrix();
  const Eigen::Matrix3d got =
      output.sensor_orientation_.cast<double>().toRotationMatrix();
  EXPECT_LT((got - orientation).norm(), 1e-5);
}

class FlashRegistrationOutput : public FlashRegistrationTest {
protected:
  FlashRegistrationOutput()
  {
    source->resize(source->size() / 4 * 4);
    source->header.frame_id = "sensor";
    source->header.stamp = 123;
    source->header.seq = 4;
    source->sensor_orientation_ =
        Eigen::Quaternionf(Eigen::AngleAxisf(0.7f, Eigen::Vector3f::UnitY()));
    registration.setInputSource(source);
    output = usedCloud();
  }

  void
  organize()
  {
    source->width = static_cast<std::uint32_t>(source->size() / 4);
    source->height = 4;
  }

  /** \brief Aligns, and compares with what PCL makes of the same. */
  void
  alignBesidePcl(const pcl::IndicesPtr& indices)
  {
    const Silence silence;
    PclAlone alone;
    Cloud by_pcl = usedCloud();
    const std::initializer_list<Base*> both{&alone, &registration};
    for (Base* aligner : both) {
      aligner->setInputSource(source);
      aligner->setInputTarget(target);
      aligner->setIndices(indices);
    }
    alone.align(by_pcl);
    registration.align(output);
    expectSameDescription(output, by_pcl);
    EXPECT_EQ(std::size_t{output.width} * output.height, output.size());
    expectSensorMoved(*source, output, registration.getResult().T_target_source);
  }

  static pcl::IndicesPtr
  everyOther(std::size_t size)
  {
    const pcl::IndicesPtr indices(new pcl::Indices);
    for (std::size_t i = 0; i < size; i += 2)
      indices->push_back(static_cast<pcl::index_t>(i));
    return indices;
  }
};

} // namespace

TEST_F(FlashRegistrationOutput, IsDescribedAsPclDoes)
{
  const pcl::IndicesPtr backwards(new pcl::Indices(source->size()));
  std::iota(backwards->rbegin(), backwards->rend(), 0);
  for (const bool organized : {false, true})
    for (const bool dense : {true, false})
      for (const auto& indices :
           {pcl::IndicesPtr(), everyOther(source->size()), backwards}) {
        if (organized)
          organize();
        source->is_dense = dense;
        alignBesidePcl(indices);
        expectFound();
      }
}

TEST_F(FlashRegistrationOutput, OfAFailureIsDescribedAsPclDoes)
{
  organize();
  registration.setCorrespondenceRandomness(0);
  for (const auto& indices : {pcl::IndicesPtr(),
                              everyOther(source->size()),
                              pcl::IndicesPtr(new pcl::Indices)}) {
    alignBesidePcl(indices);
    expectNotFound("randomness");
  }
}

TEST_F(FlashRegistrationOutput, HasTheSizeThatItSays)
{
  // A source whose points were put in by hand says that it is empty.
  source->width = source->height = 0;
  registration.align(output);
  expectFound();
  EXPECT_EQ(output.size(), source->size());
  EXPECT_EQ(output.width, source->size());
  EXPECT_EQ(output.height, 1u);
}

TEST_F(FlashRegistrationOutput, CarriesTheSensor)
{
  const RigidTransform& pose = registration.getResult().T_target_source;
  registration.align(output);
  expectFound();
  expectSensorMoved(*source, output, pose);

  const Eigen::Matrix4f guess = registration.getFinalTransformation();
  output = usedCloud();
  registration.align(output, guess);
  expectSensorMoved(*source, output, pose);

  output = usedCloud();
  static_cast<Base&>(registration).align(output);
  expectSensorMoved(*source, output, pose);

  const Cloud before = *source;
  registration.align(*source);
  expectFound();
  expectSensorMoved(before, *source, pose);
}

TEST_F(FlashRegistrationOutput, OfAFailureKeepsTheSensor)
{
  registration.setCorrespondenceRandomness(0);
  const auto expectKept = [&] {
    expectNotFound("randomness");
    expectSensorMoved(*source, output, {});
    output = usedCloud();
  };
  alignSilently();
  expectKept();
  const Silence silence;
  registration.align(output, room().T_target_source.matrix().cast<float>());
  expectKept();
  static_cast<Base&>(registration).align(output);
  expectKept();
}

TEST_F(FlashRegistrationOutput, OfTwoTypesIsTheSame)
{
  const RoomPair<pcl::PointXYZ, pcl::PointNormal> pair;
  FlashRegistration<pcl::PointXYZ, pcl::PointNormal> mixed;
  mixed.setResolution(room_resolution);
  mixed.setInputSource(source);
  mixed.setInputTarget(pair.target);
  organize();
  mixed.align(output);
  ASSERT_TRUE(mixed.hasConverged());
  expectSameDescription(output, *source);
  expectSensorMoved(*source, output, mixed.getResult().T_target_source);

  output = usedCloud();
  mixed.setIndices(everyOther(source->size()));
  mixed.align(output);
  EXPECT_EQ(output.width, source->size() / 2);
  EXPECT_EQ(output.height, 1u);
  expectSensorMoved(*source, output, mixed.getResult().T_target_source);
}

TEST_F(FlashRegistrationOutput, IsLeftAloneWhereThereIsNothingToCopy)
{
  const Silence silence;
  const Cloud before = output;
  const auto expectUntouched = [&] {
    expectSameDescription(output, before);
    EXPECT_EQ(output.sensor_origin_, before.sensor_origin_);
  };
  Registration without_source, without_target;
  without_source.setInputTarget(target);
  without_target.setInputSource(source);
  for (Registration* incomplete : {&without_source, &without_target}) {
    incomplete->align(output);
    expectUntouched();
  }
  for (const int wrong : {-1, static_cast<int>(source->size())}) {
    const pcl::IndicesPtr indices(new pcl::Indices{1, 2, wrong});
    registration.setIndices(indices);
    registration.align(output);
    expectNotFound("index " + std::to_string(wrong) + " is not one of a source of");
    expectUntouched();
  }
}

TEST_F(FlashRegistrationOutput, ThatIsAnInputSurvivesARefusal)
{
  const Silence silence;
  const Cloud source_before = *source, target_before = *target;
  const auto expectSame = [](const Cloud& a, const Cloud& b) {
    expectSameDescription(a, b);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0);
  };
  registration.align(*target);
  expectNotFound("output is the input target");
  expectSame(*target, target_before);
  registration.setIndices(everyOther(source->size()));
  registration.align(*source);
  expectNotFound("output is the input source");
  expectSame(*source, source_before);
}

TEST_F(FlashRegistrationTest, SaysWhichInputIsMissing)
{
  const Silence silence;
  for (const bool through_base : {false, true}) {
    Registration empty;
    const auto align = [&] {
      if (through_base)
        static_cast<Base&>(empty).align(output);
      else
        empty.align(output);
      EXPECT_EQ(empty.hasConverged(), empty.getErrorMessage().empty());
      return empty.getErrorMessage();
    };
    EXPECT_EQ(align(), "no input source with points was given");
    empty.setInputSource(Cloud::Ptr(new Cloud));
    EXPECT_EQ(align(), "no input source with points was given");
    empty.setInputSource(source);
    EXPECT_EQ(align(), "no input target with points was given");
    empty.setInputTarget(Cloud::ConstPtr());
    EXPECT_EQ(align(), "no input target with points was given");
    empty.setInputTarget(target);
    EXPECT_EQ(align(), "");
    EXPECT_EQ(empty.getStatus(), Status::Ok);
  }
  Registration only_target;
  only_target.setInputTarget(target);
  only_target.align(output);
  EXPECT_EQ(only_target.getErrorMessage(), "no input source with points was given");
}

TEST_F(FlashRegistrationTest, SaysWhatKeptItFromAPose)
{
  const Silence silence;
  const auto complaint = [&] {
    registration.align(output);
    expectNotFound("");
    return registration.getErrorMessage();
  };
  // Emptied after they were given.
  for (const auto& cloud : {source, target}) {
    const Cloud before = *cloud;
    cloud->clear();
    EXPECT_NE(complaint(), "");
    *cloud = before;
    registration.setInputSource(source);
    registration.setInputTarget(target);
  }
  using FeatureCloud = Registration::FeatureCloud;
  registration.setSourceFeatures(FeatureCloud::Ptr(new FeatureCloud(5, 1)));
  EXPECT_NE(complaint().find("source features for"), std::string::npos);
  registration.setSourceFeatures(
      FeatureCloud::Ptr(new FeatureCloud(static_cast<int>(source->size()), 1)));
  EXPECT_NE(complaint().find("no target features"), std::string::npos);
  registration.clearFeatures();
  registration.setCorrespondences(pcl::CorrespondencesPtr(new pcl::Correspondences));
  EXPECT_EQ(complaint(), toString(Status::TooFewCorrespondences));
  registration.setCorrespondences(nullptr);
  registration.align(output);
  expectFound();
}

TEST_F(FlashRegistrationTest, SpeaksTheSameWhateverTheLocale)
{
  const test::ForeignLocale abroad;
  registration.setResolution(1234.5);
  alignSilently();
  expectNotFound("the resolution of 1234.5 leaves ");
  registration.setResolution(-1234.5);
  alignSilently();
  expectNotFound("the resolution is -1234.5, it must be");
  registration.setResolution(room_resolution);
  registration.setInlierFraction(1.5f);
  alignSilently();
  expectNotFound("the inlier fraction is 1.5, it must be");
  registration.setInlierFraction(0);
  registration.setCorrespondenceRandomness(-12345);
  alignSilently();
  expectNotFound("the correspondence randomness is -12345, it must be");
  registration.setCorrespondenceRandomness(1);
  registration.setFrontEnd(FrontEnd::Pcl);
  registration.setResolution(1e-5);
  alignSilently();
  expectNotFound("the resolution 1e-05 is too small");
  registration.setFrontEnd(FrontEnd::Native);
  registration.setIndices(pcl::IndicesPtr(new pcl::Indices{123456}));
  alignSilently();
  expectNotFound("index 123456 is not one of a source");
}
