// Every failure that RapidCheck or the fuzzer found, shrunk, so that it stays found.
#include <gtest/gtest.h>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

struct Fixture {
  Polygon floe;
  bool is_ring;
  Ring knife;
};

// In order: a hole's vertex on the shell became a corner on one path only; a chord joined rings that touched
// elsewhere; a spike hid among the two sides of a chord; a rounded node fell on a vertex; a crack along the
// floe's edges swallowed their vertices; a dangle shorter than a step counted as a miss.
const std::vector<Fixture> kFixtures{
    {{{{0x0p+0, 0x0p+0}, {0x1p+3, 0x0p+0}, {0x1p+3, 0x1p+3}, {0x0p+0, 0x1p+3}},
      {{{0x0p+0, 0x1p+2}, {0x1p+1, 0x1.4p+2}, {0x1.8p+1, 0x1p+2}, {0x1p+1, 0x1.8p+1}},
       {{0x1.8p+1, 0x1p+2}, {0x1.4p+2, 0x1.8p+2}, {0x1.4p+2, 0x1.8p+1}}}},
     true,
     {{0x1.47ae147ae147bp-3, 0x0.0000000000001p-1022}, {0x1.45189cfae9f5ep-3, 0x1.488db5920759ap-6},
      {0x1.3d62a500a5133p-3, 0x1.45f67aa4f6104p-5},    {0x1.30ab4dff558e5p-3, 0x1.e2821a4aeececp-5},
      {0x1.1f25eea907b1ap-3, 0x1.3bb8dabffc887p-4},    {0x1.091943a9eb10fp-3, 0x1.8136005b4ee8dp-4},
      {0x1.ddbca42556683p-4, 0x1.c09ff2534a3fp-4},     {0x1.a1bdffe585424p-4, 0x1.f8f6abc9dfac5p-4},
      {0x1.5f28d19b8895cp-4, 0x1.14ab5c22ba2e5p-3},    {0x1.1709e9536b95ap-4, 0x1.287e64fe9038dp-3},
      {0x1.9508e5b1e9b48p-5, 0x1.37a4672bb17aep-3},    {0x1.eb3578b89928cp-6, 0x1.41e03a15f628ep-3},
      {0x1.4934023aed14dp-7, 0x1.47088ccbb0cccp-3},    {-0x1.4934023aed141p-7, 0x1.47088ccbb0cccp-3},
      {-0x1.eb3578b899285p-6, 0x1.41e03a15f628fp-3},   {-0x1.9508e5b1e9b4p-5, 0x1.37a4672bb17aep-3},
      {-0x1.1709e9536b95ap-4, 0x1.287e64fe9038cp-3},   {-0x1.5f28d19b8896p-4, 0x1.14ab5c22ba2e5p-3},
      {-0x1.a1bdffe585424p-4, 0x1.f8f6abc9dfac5p-4},   {-0x1.ddbca4255668p-4, 0x1.c09ff2534a3f2p-4},
      {-0x1.091943a9eb10fp-3, 0x1.8136005b4ee8ep-4},   {-0x1.1f25eea907b1ap-3, 0x1.3bb8dabffc885p-4},
      {-0x1.30ab4dff558e4p-3, 0x1.e2821a4aeecf1p-5},   {-0x1.3d62a500a5133p-3, 0x1.45f67aa4f610ep-5},
      {-0x1.45189cfae9f5ep-3, 0x1.488db592075a7p-6},   {-0x1.47ae147ae147bp-3, 0x1.6973b22a96b8ep-56},
      {-0x1.45189cfae9f5ep-3, -0x1.488db5920759bp-6},  {-0x1.3d62a500a5134p-3, -0x1.45f67aa4f60ffp-5},
      {-0x1.30ab4dff558e5p-3, -0x1.e2821a4aeececp-5},  {-0x1.1f25eea907b1ap-3, -0x1.3bb8dabffc887p-4},
      {-0x1.091943a9eb111p-3, -0x1.8136005b4ee88p-4},  {-0x1.ddbca42556685p-4, -0x1.c09ff2534a3edp-4},
      {-0x1.a1bdffe585421p-4, -0x1.f8f6abc9dfac7p-4},  {-0x1.5f28d19b8895ap-4, -0x1.14ab5c22ba2e7p-3},
      {-0x1.1709e9536b954p-4, -0x1.287e64fe9038ep-3},  {-0x1.9508e5b1e9b4ap-5, -0x1.37a4672bb17aep-3},
      {-0x1.eb3578b899287p-6, -0x1.41e03a15f628fp-3},  {-0x1.4934023aed12fp-7, -0x1.47088ccbb0cccp-3},
      {0x1.4934023aed10dp-7, -0x1.47088ccbb0cccp-3},   {0x1.eb3578b899276p-6, -0x1.41e03a15f628fp-3},
      {0x1.9508e5b1e9b43p-5, -0x1.37a4672bb17aep-3},   {0x1.1709e9536b95p-4, -0x1.287e64fe9038fp-3},
      {0x1.5f28d19b8895fp-4, -0x1.14ab5c22ba2e5p-3},   {0x1.a1bdffe58541fp-4, -0x1.f8f6abc9dfac9p-4},
      {0x1.ddbca4255667fp-4, -0x1.c09ff2534a3f3p-4},   {0x1.091943a9eb10fp-3, -0x1.8136005b4ee9p-4},
      {0x1.1f25eea907b18p-3, -0x1.3bb8dabffc88fp-4},   {0x1.30ab4dff558e5p-3, -0x1.e2821a4aeeceap-5},
      {0x1.3d62a500a5133p-3, -0x1.45f67aa4f6111p-5},   {0x1.45189cfae9f5ep-3, -0x1.488db592075acp-6}}},
    {{{{0x0p+0, 0x0p+0},
       {0x1.fd712f9a817c1p+2, 0x1.98eaecb8bcb2cp-1},
       {0x1.ca53d20369e5cp+2, 0x1.18474698cc893p+3},
       {-0x1.98eaecb8bcb2cp-1, 0x1.fd712f9a817c1p+2}},
      {{{-0x1.98eaecb8bcb2cp-2, 0x1.fd712f9a817c1p+1},
        {0x1.7da7c5a0c6843p+0, 0x1.4b2e152656d32p+2},
        {0x1.b0c52337de1a9p+0, 0x1.97a3927f6ce84p+1}}}},
     true,
     {{0x1.0e7808c360045p+4, 0x1.98eaecb8bcb2dp-1},  {0x1.0d572686f08ecp+4, 0x1.eb70451ba6554p+0},
      {0x1.09f90e1f1193dp+4, 0x1.82f23b26a1fa2p+1},  {0x1.046b580f62d21p+4, 0x1.05d76c8247bc1p+2},
      {0x1.f988e05bd68b4p+3, 0x1.46e2f87b54da7p+2},  {0x1.e646763ba090cp+3, 0x1.839526a7b2138p+2},
      {0x1.cf5d332c039adp+3, 0x1.baf8eb2764a54p+2},  {0x1.b52996d6ce41bp+3, 0x1.ec2ea662f0957p+2},
      {0x1.981569b07a548p+3, 0x1.0b37d5efbfd57p+3},  {0x1.789611e4fcc8cp+3, 0x1.1c88b22c426a5p+3},
      {0x1.572ab95ee0eb8p+3, 0x1.29c3ff3c47f23p+3},  {0x1.345a4c623cfdep+3, 0x1.32b451aa61504p+3},
      {0x1.10b158d43727cp+3, 0x1.373592e1f78edp+3},  {0x1.d97fad8c94a8ep+2, 0x1.373592e1f78edp+3},
      {0x1.922dc67088fc9p+2, 0x1.32b451aa61504p+3},  {0x1.4c8cec7741218p+2, 0x1.29c3ff3c47f23p+3},
      {0x1.09b63b6b0966cp+2, 0x1.1c88b22c426a5p+3},  {0x1.956f17a81c9e2p+1, 0x1.0b37d5efbfd57p+3},
      {0x1.211e630ecce9cp+1, 0x1.ec2ea662f0957p+2},  {0x1.709fe373ef0bp+0, 0x1.baf8eb2764a56p+2},
      {0x1.72ab95ee0eb68p-1, 0x1.839526a7b2139p+2},  {0x1.f4279f55787p-4, 0x1.46e2f87b54da6p+2},
      {-0x1.6cb0108884fep-2, 0x1.05d76c8247bc3p+2},  {-0x1.680eca3a1ab7p-1, 0x1.82f23b26a1fabp+1},
      {-0x1.d3d1d735fa17p-1, 0x1.eb70451ba656p+0},   {-0x1.f7ee1ec3e8c8p-1, 0x1.98eaecb8bcb37p-1},
      {-0x1.d3d1d735fa17p-1, -0x1.4a15618ba68a2p-2}, {-0x1.680eca3a1ab9p-1, -0x1.6cf989948740ep+0},
      {-0x1.6cb0108885p-2, -0x1.3f3962a8311ebp+1},   {0x1.f4279f557874p-4, -0x1.c1507a9a4b5b9p+1},
      {0x1.72ab95ee0eb4p-1, -0x1.1d5a6b7982e67p+2},  {0x1.709fe373ef0ap+0, -0x1.54be2ff935786p+2},
      {0x1.211e630eccea2p+1, -0x1.85f3eb34c168cp+2}, {0x1.956f17a81c9eep+1, -0x1.b034f0b1507e6p+2},
      {0x1.09b63b6b09672p+2, -0x1.d2d6a92a55a8p+2},  {0x1.4c8cec7741214p+2, -0x1.ed4d434a60b7ap+2},
      {0x1.922dc67088fc9p+2, -0x1.ff2de8269373cp+2}, {0x1.d97fad8c94a9p+2, -0x1.0418354adff87p+3},
      {0x1.10b158d437278p+3, -0x1.0418354adff87p+3}, {0x1.345a4c623cfdcp+3, -0x1.ff2de8269373cp+2},
      {0x1.572ab95ee0eb6p+3, -0x1.ed4d434a60b7ap+2}, {0x1.789611e4fcc87p+3, -0x1.d2d6a92a55a82p+2},
      {0x1.981569b07a549p+3, -0x1.b034f0b1507e2p+2}, {0x1.b52996d6ce418p+3, -0x1.85f3eb34c168ep+2},
      {0x1.cf5d332c039acp+3, -0x1.54be2ff93578bp+2}, {0x1.e646763ba090cp+3, -0x1.1d5a6b7982e6ep+2},
      {0x1.f988e05bd68b2p+3, -0x1.c1507a9a4b5c7p+1}, {0x1.046b580f62d21p+4, -0x1.3f3962a8311eap+1},
      {0x1.09f90e1f1193cp+4, -0x1.6cf989948742ep+0}, {0x1.0d572686f08ecp+4, -0x1.4a15618ba68dep-2}}},
    {{{{0x0p+0, 0x0p+0},
       {0x1.1d4d462fefe29p+3, 0x1.21d8e3954669ep+2},
       {0x1.36321c16dc402p+2, 0x1.6deb3dda0e278p+3},
       {0x1.e48f012dc25a1p+2, 0x1.3dec4143228cap+2},
       {0x1.c80746f5c3f69p+2, 0x1.2f6e35e2123a8p+2},
       {0x1.c135daddc22bap+1, 0x1.582e2cc875ac6p+3},
       {0x1.8826666dc564cp+1, 0x1.50ef2717ed836p+3},
       {0x1.7270184dc8cc3p+2, 0x1.03f413bee1444p+2},
       {0x1.55e85e15ca68cp+2, 0x1.eaec10bba1e44p+1},
       {0x1.b9f0123b9e2p+0, 0x1.3b32160655084p+3},
       {0x1.47d1295ba492p+0, 0x1.33f31055ccdf3p+3},
       {0x1.00512f6dcf3e6p+2, 0x1.93f7cc753ff7bp+1},
       {0x1.c792ea6ba1b5ep+1, 0x1.76fbb5b31f538p+1},
       {-0x1.d172288902ecp-5, 0x1.1e35ff443464p+3},
       {-0x1.0154f448834a8p-1, 0x1.16f6f993ac3bp+3},
       {0x1.1c648d1bab612p+1, 0x1.2007716cbd66fp+1},
       {0x1.c6aa31575d346p+0, 0x1.030b5aaa9cc2cp+1},
       {-0x1.d70734c42e4ebp+0, 0x1.0139e88213bfep+3},
       {-0x1.24930ed213ee4p+1, 0x1.f3f5c5a3172dap+2},
       {0x1.c135daddc22bap-2, 0x1.582e2cc875ac6p+0},
       {-0x1.d172288902ecp-8, 0x1.1e35ff443464p+0},
       {-0x1.cfc16c220a43p+1, 0x1.c87ba37fe6375p+2}},
      {}},
     false,
     {{-0x1.cfc16c220a42fp+1, 0x1.c87ba37fe6376p+2},
      {0x0.0000000000001p-1022, 0x0.0000000000001p-1022},
      {0x1.c135daddc22b9p+1, 0x1.582e2cc875ac6p+3}}},
    {{{{-0x1.bedf66a78754dp+1, -0x1.ccac73f1450c3p+2},
       {-0x1.bedf66a78754dp+0, -0x1.ccac73f1450c3p+1},
       {-0x1.6ef83108650a4p+1, -0x1.ce676d7489badp+1},
       {-0x1.bedf66a78754ep+0, -0x1.ccac73f1450c4p+1},
       {-0x1.96517417012c4p+2, -0x1.73f8dda3dd45p+2}},
      {}},
     true,
     {{-0x1.bedf66a78754cp+0, -0x1.ccac73f1450c4p+1},
      {-0x1.c76b0dd3dbbacp+2, -0x1.ccac73f1450c3p+1},
      {-0x1.bedf66a78754cp+1, -0x1.ccac73f1450c2p+2}}},
    {{{{0x1.447b0bb0832dfp+3, 0x1.2000000000001p+2},
       {0x1.447b0bb0832dfp+3, 0x1.2p+2},
       {0x1.447b0bb0832ep+3, 0x1.1ffffffffffffp+2},
       {0x1.447b0bb0832e1p+3, 0x1.2p+2},
       {0x1.447b0bb0832e1p+3, 0x1.2000000000001p+2},
       {0x1.447b0bb0832e1p+3, 0x1.2000000000002p+2},
       {0x1.447b0bb0832ep+3, 0x1.2000000000003p+2},
       {0x1.447b0bb0832dfp+3, 0x1.2000000000002p+2}},
      {}},
     false,
     {{0x1.447b0bb0832dfp+3, 0x1.2p+2},
      {0x1.447b0bb0832e1p+3, 0x1.1ffffffffffffp+2},
      {0x1.447b0bb0832e1p+3, 0x1.2000000000002p+2}}},
    {{{{-0x1.d5e13907c5b62p+19, 0x1.1581c357417d2p+19},
       {-0x1.4c8bfc2d1d56p+19, 0x1.6588ee357eee1p+19},
       {-0x1.4c8bfc2d1d56p+20, 0x1.6588ee357eee1p+20},
       {-0x1.9a85e4d04e71dp+20, 0x1.215ac4edbd7ep+20}},
      {}},
     false,
     {{-0x1.7388f07eb5e3fp+20, 0x1.4371d9919e36p+20}, {-0x1.f25088f6843d2p+20, 0x1.6ca7b68ecbdddp+20}}},
};

TEST(Fixtures, FailuresOnceFoundStayFixed) {
  for (std::size_t i = 0; i < kFixtures.size(); ++i) {
    SCOPED_TRACE(i);
    const Fixture& fixture = kFixtures[i];
    ASSERT_FALSE(find_defect(fixture.floe));
    const Shape shape{fixture.floe};
    const exact::Polygon exact_shape = exact::exactly(fixture.floe);
    const CutOutcome outcome =
        fixture.is_ring ? cut_by_polygon(shape, {fixture.knife, {}}) : cut_along(shape, fixture.knife);
    EXPECT_TRUE(trials::is_sound(shape, outcome));
    EXPECT_TRUE(trials::are_equal(outcome, fixture.is_ring
                                               ? cut_by_polygons_generally(exact_shape, {{fixture.knife, {}}})
                                               : cut_along_generally(exact_shape, fixture.knife)));
  }
}

}  // namespace
}  // namespace polynya::geometry
