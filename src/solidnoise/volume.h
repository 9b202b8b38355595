// All of the component volume: recipes of OpenVDB grids, made, modified, merged, described and pictured; their files.
#pragma once

