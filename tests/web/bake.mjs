// SPDX-License-Identifier: Apache-2.0
// Bakes before the tests do, which run side by side.
import { toolFolder } from './scene/tools.mjs';

await toolFolder();
