// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Private names live in the namespace of their room, mesamis::detail::ROOM. By these directives a
/// file uses what it includes without that prefix; rooms.txt says what a room may include. No
/// header that is installed includes this one.
namespace mesamis {
namespace detail::base {}
using namespace detail::base;
namespace detail::image {}
using namespace detail::image;
namespace detail::mesh {}
using namespace detail::mesh;
namespace detail::restore {}
using namespace detail::restore;
namespace detail::object {}
using namespace detail::object;
namespace detail::fem {}
using namespace detail::fem;
namespace detail::adapt {}
using namespace detail::adapt;
namespace detail::remesh {}
using namespace detail::remesh;
namespace detail::surface {}
using namespace detail::surface;
namespace detail::body {}
using namespace detail::body;
namespace detail::decimate {}
using namespace detail::decimate;
namespace detail::labels {}
using namespace detail::labels;
namespace detail::fit {}
using namespace detail::fit;
namespace detail::method {}
using namespace detail::method;
namespace detail::slabs {}
using namespace detail::slabs;
namespace detail::files {}
using namespace detail::files;
namespace detail::volume_files {}
using namespace detail::volume_files;
namespace detail::label_files {}
using namespace detail::label_files;
namespace detail::shape_files {}
using namespace detail::shape_files;
namespace detail::picture {}
using namespace detail::picture;
namespace detail::report {}
using namespace detail::report;
namespace detail::page {}
using namespace detail::page;
namespace detail::run {}
using namespace detail::run;
namespace detail::phantom {}
using namespace detail::phantom;
namespace detail::parallel {}
using namespace detail::parallel;
namespace detail::baseline {}
using namespace detail::baseline;
namespace detail::printing {}
using namespace detail::printing;
namespace detail::study {}
using namespace detail::study;
}  // namespace mesamis
